//! The kinds of tokens and nodes.
//!
//! Tokens and nodes have an enumeration each, so that a match over nodes needs no arm for commas. Every keyword
//! of every dialect has a token kind of its own. A *soft* keyword is one that programmers also use as a name
//! (`SET`, `STEP`, `ACTION`, …); where the grammar takes it as a name, the parser turns the token into
//! [`TokenKind::Ident`], so that a later room never asks whether a name happens to look like a keyword.

macro_rules! token_kinds {
    (
        plain { $($(#[doc = $doc:literal])* $plain:ident,)* }
        punctuation { $($punct:ident = $punct_text:literal,)* }
        hard { $($hard:ident = $hard_text:literal,)* }
        soft { $($soft:ident = $soft_text:literal,)* }
    ) => {
        /// What a token is.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u8)]
        pub enum TokenKind {
            $($(#[doc = $doc])* $plain,)*
            $(#[doc = concat!("`", $punct_text, "`")] $punct,)*
            $(#[doc = concat!("`", $hard_text, "`, which no name may be.")] $hard,)*
            $(#[doc = concat!("`", $soft_text, "`, where it is no name.")] $soft,)*
        }

        impl TokenKind {
            /// How a message writes the kind: the text of punctuation and keywords, a noun for the others.
            #[must_use]
            pub const fn describe(self) -> &'static str {
                match self {
                    $(Self::$punct => concat!("`", $punct_text, "`"),)*
                    $(Self::$hard => concat!("`", $hard_text, "`"),)*
                    $(Self::$soft => concat!("`", $soft_text, "`"),)*
                    Self::Ident | Self::QuotedName => "a name",
                    Self::Eof => "the end of the text",
                    _ => "a literal",
                }
            }

            /// Whether this is a keyword that is also allowed as a name.
            #[must_use]
            pub const fn is_soft_keyword(self) -> bool {
                matches!(self, $(Self::$soft)|*)
            }

            /// Whether this is a keyword that no name may be.
            #[must_use]
            pub const fn is_hard_keyword(self) -> bool {
                matches!(self, $(Self::$hard)|*)
            }
        }

        /// Every keyword with its kind, in upper case.
        pub(super) const KEYWORDS: &[(&str, TokenKind)] = &[
            $(($hard_text, TokenKind::$hard),)*
            $(($soft_text, TokenKind::$soft),)*
            ("ELSEIF", TokenKind::Elsif),
        ];
    };
}

token_kinds! {
    plain {
        /// Blanks and tabs, no line break.
        Blank,
        /// One line break.
        Newline,
        /// `// …` to the end of the line.
        LineComment,
        /// `(* … *)` or `/* … */`.
        BlockComment,
        /// `{ … }`.
        Pragma,
        /// Characters that belong to no token.
        Unknown,
        /// The end of the text; the parser's sentinel, never in a tree.
        Eof,
        /// A name.
        Ident,
        /// A name in double quotes (Siemens).
        QuotedName,
        /// `12`, `1_000`.
        Integer,
        /// `16#FF`, `2#1010_0101`.
        Based,
        /// `1.5`, `1.5E-3`, `2e6`.
        Real,
        /// `'…'`.
        String,
        /// `"…"`, where it is no name.
        WString,
        /// `T#1d2h`, `LTIME#5s`, `S5T#2s`.
        Duration,
        /// `D#2020-02-29`.
        Date,
        /// `TOD#12:30:15.5`.
        TimeOfDay,
        /// `DT#2020-02-29-12:30:15`.
        DateAndTime,
        /// A type's name and `#`, before a literal or an enumeration value: `INT#`.
        TypePrefix,
        /// `%IX0.0`, `%MW3`, `%Q*`, `%X3`.
        Address,
    }
    punctuation {
        LParen = "(", RParen = ")", LBracket = "[", RBracket = "]",
        Comma = ",", Semicolon = ";", Colon = ":", Dot = ".", DotDot = "..", Caret = "^", Hash = "#", Question = "?",
        Assign = ":=", Arrow = "=>", TryAssign = "?=",
        PlusAssign = "+=", MinusAssign = "-=", StarAssign = "*=", SlashAssign = "/=",
        Equal = "=", NotEqual = "<>", Less = "<", LessEqual = "<=", Greater = ">", GreaterEqual = ">=",
        Plus = "+", Minus = "-", Star = "*", Power = "**", Slash = "/", Ampersand = "&",
    }
    hard {
        If = "IF", Then = "THEN", Elsif = "ELSIF", Else = "ELSE", EndIf = "END_IF",
        Case = "CASE", Of = "OF", EndCase = "END_CASE",
        For = "FOR", To = "TO", By = "BY", Do = "DO", EndFor = "END_FOR",
        While = "WHILE", EndWhile = "END_WHILE", Repeat = "REPEAT", Until = "UNTIL", EndRepeat = "END_REPEAT",
        Exit = "EXIT", Return = "RETURN",
        And = "AND", Or = "OR", Xor = "XOR", Not = "NOT", Mod = "MOD", True = "TRUE", False = "FALSE",
        Var = "VAR", VarInput = "VAR_INPUT", VarOutput = "VAR_OUTPUT", VarInOut = "VAR_IN_OUT", VarTemp = "VAR_TEMP",
        VarStat = "VAR_STAT", VarInst = "VAR_INST", VarExternal = "VAR_EXTERNAL", VarGlobal = "VAR_GLOBAL",
        VarConfig = "VAR_CONFIG", VarAccess = "VAR_ACCESS", VarGeneric = "VAR_GENERIC", EndVar = "END_VAR",
        FunctionBlock = "FUNCTION_BLOCK", EndFunctionBlock = "END_FUNCTION_BLOCK",
        Function = "FUNCTION", EndFunction = "END_FUNCTION", Program = "PROGRAM", EndProgram = "END_PROGRAM",
        EndInterface = "END_INTERFACE", EndClass = "END_CLASS", EndMethod = "END_METHOD",
        EndProperty = "END_PROPERTY", EndGet = "END_GET", EndSet = "END_SET",
        EndAction = "END_ACTION", EndTransition = "END_TRANSITION", EndStep = "END_STEP",
        Type = "TYPE", EndType = "END_TYPE", Struct = "STRUCT", EndStruct = "END_STRUCT", EndUnion = "END_UNION",
        Array = "ARRAY", EndNamespace = "END_NAMESPACE", EndConfiguration = "END_CONFIGURATION",
        EndResource = "END_RESOURCE", OrganizationBlock = "ORGANIZATION_BLOCK",
        EndOrganizationBlock = "END_ORGANIZATION_BLOCK", DataBlock = "DATA_BLOCK", EndDataBlock = "END_DATA_BLOCK",
        EndRegion = "END_REGION", EndConst = "END_CONST",
        Try = "__TRY", Catch = "__CATCH", Finally = "__FINALLY", EndTry = "__ENDTRY",
    }
    soft {
        Interface = "INTERFACE", Class = "CLASS", Method = "METHOD",
        Property = "PROPERTY", PropertyGet = "PROPERTY_GET", PropertySet = "PROPERTY_SET", Get = "GET", Set = "SET",
        EndPropertyGet = "END_PROPERTY_GET", EndPropertySet = "END_PROPERTY_SET",
        Algorithm = "ALGORITHM", EndAlgorithm = "END_ALGORITHM",
        Action = "ACTION", Actions = "ACTIONS", EndActions = "END_ACTIONS", Transition = "TRANSITION",
        InitialStep = "INITIAL_STEP", Step = "STEP", From = "FROM", Priority = "PRIORITY",
        Namespace = "NAMESPACE", Using = "USING", Configuration = "CONFIGURATION", Resource = "RESOURCE",
        Task = "TASK", On = "ON", With = "WITH",
        Public = "PUBLIC", Private = "PRIVATE", Protected = "PROTECTED", Internal = "INTERNAL",
        Abstract = "ABSTRACT", Final = "FINAL", Override = "OVERRIDE", Extends = "EXTENDS", Implements = "IMPLEMENTS",
        Constant = "CONSTANT", Retain = "RETAIN", NonRetain = "NON_RETAIN", Persistent = "PERSISTENT", At = "AT",
        StringType = "STRING", WStringType = "WSTRING", Pointer = "POINTER", Reference = "REFERENCE",
        RefTo = "REF_TO", Ref = "REF", Union = "UNION", Overlap = "OVERLAP", Vector = "__VECTOR",
        REdge = "R_EDGE", FEdge = "F_EDGE", ReadOnly = "READ_ONLY", ReadWrite = "READ_WRITE",
        AndThen = "AND_THEN", OrElse = "OR_ELSE", This = "THIS", Super = "SUPER", Null = "NULL",
        Continue = "CONTINUE", Jmp = "JMP", Goto = "GOTO", S = "S", R = "R",
        Region = "REGION", Begin = "BEGIN", Const = "CONST", Label = "LABEL", EndLabel = "END_LABEL",
        Title = "TITLE", Version = "VERSION", Author = "AUTHOR", Family = "FAMILY", NameProperty = "NAME",
        KnowHowProtect = "KNOW_HOW_PROTECT",
    }
}

impl TokenKind {
    /// Whether the grammar steps over this kind: blanks, line breaks, comments and pragmas.
    #[must_use]
    pub const fn is_trivia(self) -> bool {
        (self as u8) <= Self::Pragma as u8
    }

    /// Whether this is a comment.
    #[must_use]
    pub const fn is_comment(self) -> bool {
        matches!(self, Self::LineComment | Self::BlockComment)
    }

    /// Whether this is a keyword.
    #[must_use]
    pub const fn is_keyword(self) -> bool {
        (self as u8) >= Self::If as u8
    }

    /// Whether this is a keyword that closes something: `END_VAR`, `END_IF`.
    #[must_use]
    pub fn is_end(self) -> bool {
        self.is_keyword() && (self.describe().starts_with("`END_") || self == Self::EndTry)
    }

    /// Whether this is a literal that stands alone, `TRUE`, `FALSE` and `NULL` among them.
    #[must_use]
    pub const fn is_literal(self) -> bool {
        let plain = Self::Integer as u8 <= self as u8 && self as u8 <= Self::DateAndTime as u8;
        plain || matches!(self, Self::True | Self::False | Self::Null)
    }
}

macro_rules! node_kinds {
    ($($(#[doc = $doc:literal])* $kind:ident,)*) => {
        /// What a node is.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u8)]
        pub enum NodeKind {
            $($(#[doc = $doc])* $kind,)*
        }

        impl NodeKind {
            /// The kind's name, as the dump of a tree prints it.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self { $(Self::$kind => stringify!($kind),)* }
            }
        }
    };
}

node_kinds! {
    /// A whole text, whatever it was parsed as.
    SourceFile,
    /// Tokens that were skipped, because they fit nowhere.
    Error,
    /// `FUNCTION_BLOCK … END_FUNCTION_BLOCK`.
    FunctionBlock,
    /// `FUNCTION … END_FUNCTION`.
    Function,
    /// `PROGRAM … END_PROGRAM`.
    Program,
    /// `CLASS … END_CLASS`.
    Class,
    /// `INTERFACE … END_INTERFACE`.
    Interface,
    /// `ORGANIZATION_BLOCK … END_ORGANIZATION_BLOCK` (Siemens).
    OrganizationBlock,
    /// `DATA_BLOCK … END_DATA_BLOCK` (Siemens).
    DataBlock,
    /// `METHOD … END_METHOD`.
    Method,
    /// `PROPERTY … END_PROPERTY`.
    Property,
    /// `GET … END_GET` or `SET … END_SET` of a property.
    Accessor,
    /// `ACTION … END_ACTION`, `ALGORITHM … END_ALGORITHM` (IEC 61499).
    Action,
    /// `ACTIONS pou … END_ACTIONS`: the actions of a POU, apart from it.
    Actions,
    /// `TRANSITION … END_TRANSITION`.
    Transition,
    /// `NAMESPACE … END_NAMESPACE`.
    Namespace,
    /// `USING a, b.c;`.
    Using,
    /// `TYPE … END_TYPE`.
    TypeBlock,
    /// One type in it.
    TypeDecl,
    /// `CONFIGURATION … END_CONFIGURATION`.
    Configuration,
    /// `RESOURCE … ON … END_RESOURCE`.
    Resource,
    /// `TASK t(…);`.
    Task,
    /// `PROGRAM p WITH t : P(…);` in a configuration.
    ProgramConfiguration,
    /// `TITLE = …`, `VERSION : 0.1` and the like (Siemens).
    BlockProperty,
    /// `EXTENDS a, b`.
    ExtendsClause,
    /// `IMPLEMENTS a, b`.
    ImplementsClause,
    /// `VAR … END_VAR` and its relatives.
    VarSection,
    /// `a, b AT %I* : T := x;`.
    VarDecl,
    /// The same in a `STRUCT` or `UNION`.
    Field,
    /// `AT %QX0.1`.
    Location,
    /// A name where it is declared.
    Name,
    /// A name with dots, where it names a type, an interface or a namespace.
    Path,
    /// A type that is named, perhaps with the arguments of its constructor.
    NamedType,
    /// `ARRAY[…] OF …`.
    ArrayType,
    /// `POINTER TO …`.
    PointerType,
    /// `REFERENCE TO …`, `REF_TO …`.
    ReferenceType,
    /// `STRING`, `STRING[80]`, `WSTRING(N)`.
    StringType,
    /// `INT(0..10)`.
    SubrangeType,
    /// `(A, B := 2) UINT`, `UINT (A, B)`.
    EnumType,
    /// One value of it.
    EnumValue,
    /// `STRUCT … END_STRUCT`.
    StructType,
    /// `UNION … END_UNION`.
    UnionType,
    /// `a..b`, in a type or a case label.
    Range,
    /// The `*` of `ARRAY[*]`.
    OpenDimension,
    /// The statements, steps or instructions of a declaration.
    Body,
    /// The statements in a statement.
    StatementList,
    /// `a := b;`, with `REF=`, `?=`, `S=`, `R=` or `+=` as well.
    AssignStatement,
    /// A call, or an expression without effect.
    ExpressionStatement,
    /// `IF`.
    IfStatement,
    /// `ELSIF … THEN …`.
    ElsifClause,
    /// `ELSE …`.
    ElseClause,
    /// `CASE`.
    CaseStatement,
    /// One branch of it: labels and statements.
    CaseBranch,
    /// `FOR`.
    ForStatement,
    /// `WHILE`.
    WhileStatement,
    /// `REPEAT`.
    RepeatStatement,
    /// `EXIT;`.
    ExitStatement,
    /// `CONTINUE;`.
    ContinueStatement,
    /// `RETURN;`.
    ReturnStatement,
    /// `JMP label;`, `GOTO label;`.
    JumpStatement,
    /// `label:`.
    LabelStatement,
    /// `__TRY`.
    TryStatement,
    /// `__CATCH(e) …`.
    CatchClause,
    /// `__FINALLY …`.
    FinallyClause,
    /// `REGION … END_REGION` (Siemens).
    RegionStatement,
    /// A lone `;`.
    EmptyStatement,
    /// A variable, function or value by its name.
    NameExpression,
    /// `a.b`.
    FieldExpression,
    /// `a.3`, `a.%X3`.
    BitExpression,
    /// `a[i, j]`.
    IndexExpression,
    /// `a^`.
    DerefExpression,
    /// `f(…)`.
    CallExpression,
    /// The arguments with their parentheses.
    ArgumentList,
    /// One argument.
    Argument,
    /// `-a`, `+a`, `NOT a`.
    UnaryExpression,
    /// `a + b`.
    BinaryExpression,
    /// `(a)`.
    ParenExpression,
    /// `a := b` as an expression.
    AssignExpression,
    /// `1`, `INT#1`, `TRUE`, `'text'`, `T#1s`.
    Literal,
    /// `T#V`, a value of the enumeration `T`.
    EnumLiteral,
    /// `%IX0.0`.
    AddressExpression,
    /// `THIS`.
    ThisExpression,
    /// `SUPER`.
    SuperExpression,
    /// `[1, 2, 3(0)]`, or the old list without brackets.
    ArrayInitializer,
    /// `(a := 1, b := 2)`.
    StructInitializer,
    /// `3(0)` in an array's initial value.
    RepeatInitializer,
    /// `INITIAL_STEP` or `STEP`.
    Step,
    /// `Motor(N);` in a step.
    ActionAssociation,
    /// The steps that a transition comes from or goes to.
    StepNames,
    /// The instructions of a body in Instruction List.
    InstructionList,
    /// One instruction.
    Instruction,
    /// `EVENT_INPUT … END_EVENT`, `EC_STATES … END_STATES` and the like (IEC 61499), as tokens.
    EventSection,
}
