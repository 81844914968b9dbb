//! From the events of pulldown-cmark to blocks, with a stack of its own: a comment may nest
//! quotations deeper than a call stack reaches.

use pulldown_cmark::{Alignment, BlockQuoteKind, CodeBlockKind, Event, Tag};

use crate::docs::prose::{Align, Block, Inline, LinkTarget, ListItem};
use crate::text::Place;

/// Containers deeper than this are dissolved into the one around them.
const DEPTH: usize = 40;

enum Kind {
    Root,
    Dissolved,
    Paragraph,
    Heading(u8),
    Quote,
    Alert(&'static str, &'static str),
    List(Option<u64>),
    Item(Option<bool>),
    Code(String),
    Table(Vec<Align>),
    Head,
    Row,
    Cell,
    Footnote(String),
    Emph,
    Strong,
    Strike,
    Link(Option<LinkTarget>, Place),
    Image(String),
}

struct Frame {
    kind: Kind,
    blocks: Vec<Block>,
    inlines: Vec<Inline>,
    items: Vec<ListItem>,
    cells: Vec<Vec<Inline>>,
    rows: Vec<Vec<Vec<Inline>>>,
}

impl Frame {
    const fn new(kind: Kind) -> Self {
        Self { kind, blocks: Vec::new(), inlines: Vec::new(), items: Vec::new(), cells: Vec::new(), rows: Vec::new() }
    }

    /// The blocks in it, with loose inlines as a paragraph.
    fn flush(&mut self) {
        let inlines = std::mem::take(&mut self.inlines);
        if !inlines.is_empty() {
            self.blocks.push(Block::Paragraph(tidy(inlines)));
        }
    }

    fn text(&mut self, text: &str) {
        if let Some(Inline::Text(last)) = self.inlines.last_mut() {
            last.push_str(text);
        } else {
            self.inlines.push(Inline::Text(text.to_owned()));
        }
    }
}

/// Builds blocks from events.
pub(super) struct Builder<'a> {
    source: &'a str,
    width: usize,
    stack: Vec<Frame>,
    notes: Vec<Block>,
}

impl<'a> Builder<'a> {
    /// Builds from `source`; `wrapped` if its breaks may be meant.
    pub(super) fn new(source: &'a str, wrapped: bool) -> Self {
        let width = source.lines().map(|line| line.trim().chars().count()).max().unwrap_or(0);
        let width = if wrapped { width } else { 0 };
        Self { source, width, stack: vec![Frame::new(Kind::Root)], notes: Vec::new() }
    }

    pub(super) fn open(&mut self, tag: Tag<'_>) {
        let kind = match tag {
            Tag::Paragraph => Kind::Paragraph,
            Tag::Heading { level, .. } => Kind::Heading(level as u8),
            Tag::BlockQuote(Some(kind)) => alert(kind),
            Tag::BlockQuote(None) => Kind::Quote,
            Tag::CodeBlock(CodeBlockKind::Fenced(info)) => {
                Kind::Code(info.split([' ', ',', '\t']).next().unwrap_or("").to_lowercase())
            }
            Tag::CodeBlock(CodeBlockKind::Indented) => Kind::Code(String::new()),
            Tag::List(start) => Kind::List(start),
            Tag::Item => Kind::Item(None),
            Tag::FootnoteDefinition(name) => Kind::Footnote(name.to_string()),
            Tag::Table(align) => Kind::Table(align.into_iter().map(read_align).collect()),
            Tag::TableHead => Kind::Head,
            Tag::TableRow => Kind::Row,
            Tag::TableCell => Kind::Cell,
            Tag::Emphasis => Kind::Emph,
            Tag::Strong => Kind::Strong,
            Tag::Strikethrough => Kind::Strike,
            Tag::Image { dest_url, .. } => Kind::Image(dest_url.to_string()),
            _ => Kind::Dissolved,
        };
        self.push(kind);
    }

    pub(super) fn open_link(&mut self, target: Option<LinkTarget>, place: Place) {
        self.push(Kind::Link(target, place));
    }

    fn push(&mut self, kind: Kind) {
        let deep = self.stack.len() > DEPTH;
        self.stack.push(Frame::new(if deep { Kind::Dissolved } else { kind }));
    }

    /// A line break in the source at `at`.
    pub(super) fn soft_break(&mut self, at: usize) {
        let line = self.source[..at].rsplit('\n').next().unwrap_or("").trim().chars().count();
        let next = self.source[at..].split_whitespace().next().unwrap_or("").chars().count();
        if line + 1 + next + SLACK < self.width.min(WIDTH) && self.width > NARROW {
            self.top().inlines.push(Inline::Break);
        } else {
            self.top().text(" ");
        }
    }

    pub(super) fn leaf(&mut self, event: Event<'_>) {
        match event {
            Event::Text(text) => self.text(&text),
            Event::Code(code) => self.top().inlines.push(Inline::Code(code.to_string())),
            Event::Html(html) | Event::InlineHtml(html) => self.top().text(&html),
            Event::HardBreak => self.top().inlines.push(Inline::Break),
            Event::Rule => self.blocks(vec![Block::Rule]),
            Event::FootnoteReference(name) => self.top().text(&format!("[{name}]")),
            Event::TaskListMarker(done) => {
                if let Some(Frame { kind: Kind::Item(checked), .. }) =
                    self.stack.iter_mut().rev().find(|frame| matches!(frame.kind, Kind::Item(_)))
                {
                    *checked = Some(done);
                }
            }
            Event::InlineMath(text) | Event::DisplayMath(text) => self.top().text(&text),
            _ => {}
        }
    }

    /// Text, in which bare addresses become links.
    fn text(&mut self, text: &str) {
        if matches!(self.top().kind, Kind::Code(_)) {
            self.top().text(text);
            return;
        }
        self.top().text(text);
    }

    pub(super) fn close(&mut self) {
        if self.stack.len() < 2 {
            return;
        }
        let Some(mut frame) = self.stack.pop() else { return };
        match std::mem::replace(&mut frame.kind, Kind::Root) {
            Kind::Root | Kind::Dissolved => self.dissolve(frame),
            Kind::Paragraph => self.blocks(paragraph(frame.inlines)),
            Kind::Heading(level) => self.blocks(vec![Block::Heading(level, tidy(frame.inlines))]),
            Kind::Quote => {
                frame.flush();
                self.blocks(vec![Block::Quote(frame.blocks)]);
            }
            Kind::Alert(style, title) => {
                frame.flush();
                let (style, title) = (style.to_owned(), title.to_owned());
                self.blocks(vec![Block::Note { style, title, content: frame.blocks }]);
            }
            Kind::List(start) => self.blocks(vec![Block::List { start, items: frame.items }]),
            Kind::Item(checked) => {
                frame.flush();
                self.top().items.push(ListItem { checked, content: frame.blocks });
            }
            Kind::Code(language) => {
                let text = Inline::plain(&frame.inlines);
                let text = text.strip_suffix('\n').unwrap_or(&text).to_owned();
                self.blocks(vec![Block::Code { language, text }]);
            }
            Kind::Table(align) => {
                self.blocks(vec![Block::Table { align, head: frame.cells, rows: frame.rows }]);
            }
            Kind::Head => self.top().cells = frame.cells,
            Kind::Row => self.top().rows.push(frame.cells),
            Kind::Cell => self.top().cells.push(tidy(frame.inlines)),
            Kind::Footnote(name) => {
                frame.inlines.insert(0, Inline::Text(format!("[{name}] ")));
                frame.flush();
                self.notes.append(&mut frame.blocks);
            }
            Kind::Emph => self.inline(Inline::Emph(frame.inlines)),
            Kind::Strong => self.inline(Inline::Strong(frame.inlines)),
            Kind::Strike => self.inline(Inline::Strike(frame.inlines)),
            Kind::Link(Some(target), place) => {
                self.inline(Inline::Link { target, place, content: frame.inlines });
            }
            Kind::Link(None, _) => self.top().inlines.extend(frame.inlines),
            Kind::Image(source) => {
                self.inline(Inline::Image { source, alt: Inline::plain(&frame.inlines) });
            }
        }
    }

    pub(super) fn blocks(&mut self, blocks: Vec<Block>) {
        let top = self.top();
        top.flush();
        top.blocks.extend(blocks);
    }

    pub(super) fn finish(mut self) -> Vec<Block> {
        while self.stack.len() > 1 {
            self.close();
        }
        let mut blocks = std::mem::take(&mut self.notes);
        let top = self.top();
        top.flush();
        let mut out = std::mem::take(&mut top.blocks);
        out.append(&mut blocks);
        out
    }

    fn dissolve(&mut self, frame: Frame) {
        let top = self.top();
        if !frame.blocks.is_empty() {
            top.flush();
            top.blocks.extend(frame.blocks);
        }
        top.inlines.extend(frame.inlines);
        top.inlines.extend(frame.cells.into_iter().chain(frame.rows.into_iter().flatten()).flatten());
        for item in frame.items {
            top.blocks.extend(item.content);
        }
    }

    fn inline(&mut self, inline: Inline) {
        self.top().inlines.push(inline);
    }

    fn top(&mut self) -> &mut Frame {
        if self.stack.is_empty() {
            self.stack.push(Frame::new(Kind::Root));
        }
        let last = self.stack.len() - 1;
        &mut self.stack[last]
    }
}

/// Room that a ragged right margin leaves before a break counts as meant.
const SLACK: usize = 16;
/// Lines longer than this are not wrapped by hand, and say nothing about the margin.
const WIDTH: usize = 100;
/// Text narrower than this has no margin to speak of.
const NARROW: usize = 24;

fn paragraph(inlines: Vec<Inline>) -> Vec<Block> {
    let inlines = tidy(inlines);
    if inlines.is_empty() { Vec::new() } else { vec![Block::Paragraph(inlines)] }
}

/// Without white space and breaks at the end.
fn tidy(mut inlines: Vec<Inline>) -> Vec<Inline> {
    loop {
        match inlines.last_mut() {
            Some(Inline::Break) => {
                inlines.pop();
            }
            Some(Inline::Text(text)) => {
                text.truncate(text.trim_end().len());
                if !text.is_empty() {
                    return inlines;
                }
                inlines.pop();
            }
            _ => return inlines,
        }
    }
}

const fn alert(kind: BlockQuoteKind) -> Kind {
    match kind {
        BlockQuoteKind::Note => Kind::Alert("note", "Note"),
        BlockQuoteKind::Tip => Kind::Alert("note", "Hint"),
        BlockQuoteKind::Important => Kind::Alert("warning", "Important"),
        BlockQuoteKind::Warning | BlockQuoteKind::Caution => Kind::Alert("warning", "Warning"),
    }
}

const fn read_align(align: Alignment) -> Align {
    match align {
        Alignment::None => Align::None,
        Alignment::Left => Align::Left,
        Alignment::Center => Align::Center,
        Alignment::Right => Align::Right,
    }
}
