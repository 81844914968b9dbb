//! What a user may choose for the PDF.

use std::collections::BTreeMap;

use typst::foundations::Datetime;
use typst_pdf::{PdfStandard, Timestamp};

/// What a user may choose.
#[derive(Clone, Debug)]
pub struct Options {
    /// The size of a page.
    pub paper: Paper,
    /// Font files, which go before the embedded fonts.
    pub fonts: Vec<Vec<u8>>,
    /// Families for text, the first that exists for each character.
    pub text_fonts: Vec<String>,
    /// Families for code, the first that exists for each character.
    pub mono_fonts: Vec<String>,
    /// The standard that the file has to meet.
    pub standard: Standard,
    /// Whether the file carries its structure for screen readers; it is several times as large then.
    pub tagged: bool,
    /// What is printed.
    pub parts: Parts,
    /// Templates that replace embedded ones or add to them, by name such as `templates/pdf/style.typ`.
    pub templates: BTreeMap<String, String>,
    /// When the file is made; nothing is written without it.
    pub date: Option<Date>,
    /// The program that makes it.
    pub creator: String,
    /// Files inside the PDF; only PDF/A-3 and plain PDF hold any.
    pub attachments: Vec<Attachment>,
}

/// A file inside the PDF.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Attachment {
    /// Its name as a viewer lists it.
    pub path: String,
    /// Its content.
    pub bytes: Vec<u8>,
    /// Its media type.
    pub mime: String,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            paper: Paper::A4,
            fonts: Vec::new(),
            text_fonts: vec!["Libertinus Serif".to_owned()],
            mono_fonts: vec!["DejaVu Sans Mono".to_owned()],
            standard: Standard::Pdf17,
            tagged: false,
            parts: Parts::default(),
            templates: BTreeMap::new(),
            date: None,
            creator: "rungbook".to_owned(),
            attachments: Vec::new(),
        }
    }
}

/// The size of a page.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Paper {
    /// 210 × 297 mm.
    #[default]
    A4,
    /// 176 × 250 mm.
    B5,
    /// 8.5 × 11 in.
    Letter,
}

impl Paper {
    /// The typesetter's name for it.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::A4 => "a4",
            Self::B5 => "iso-b5",
            Self::Letter => "us-letter",
        }
    }

    /// Its width and height in points.
    pub(super) fn size(self) -> (f64, f64) {
        match self {
            Self::A4 => (595.28, 841.89),
            Self::B5 => (498.9, 708.66),
            Self::Letter => (612.0, 792.0),
        }
    }
}

/// What is printed besides the entities themselves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "each is a part that a user includes or not")]
pub struct Parts {
    /// The narrative chapters.
    pub chapters: bool,
    /// Variables that do not belong to the interface.
    pub internals: bool,
    /// Test tables.
    pub tables: bool,
    /// The source listings.
    pub sources: bool,
    /// How much is documented and verified.
    pub coverage: bool,
    /// The list of what is not documented.
    pub holes: bool,
    /// The findings and the files that were skipped.
    pub findings: bool,
    /// The index.
    pub index: bool,
}

impl Default for Parts {
    fn default() -> Self {
        Self {
            chapters: true,
            internals: true,
            tables: true,
            sources: false,
            coverage: true,
            holes: false,
            findings: true,
            index: true,
        }
    }
}

/// A standard for the file. The file is written with the standard's checks on, not certified.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Standard {
    /// PDF 1.7.
    #[default]
    Pdf17,
    /// PDF/A-1b, for archives that take nothing newer.
    A1b,
    /// PDF/A-2b, for archives.
    A2b,
    /// PDF/A-3b, for archives, with attachments.
    A3b,
    /// PDF/A-3a, for archives, with structure.
    A3a,
    /// PDF/UA-1, for screen readers.
    Ua1,
    /// PDF/A-3a and PDF/UA-1 at once.
    A3aUa1,
}

impl Standard {
    /// The typesetter's names.
    pub(super) fn list(self) -> &'static [PdfStandard] {
        match self {
            Self::Pdf17 => &[PdfStandard::V_1_7],
            Self::A1b => &[PdfStandard::A_1b],
            Self::A2b => &[PdfStandard::A_2b],
            Self::A3b => &[PdfStandard::A_3b],
            Self::A3a => &[PdfStandard::A_3a],
            Self::Ua1 => &[PdfStandard::Ua_1],
            Self::A3aUa1 => &[PdfStandard::A_3a, PdfStandard::Ua_1],
        }
    }

    /// Whether it asks for structure.
    pub(super) fn needs_tags(self) -> bool {
        matches!(self, Self::A3a | Self::Ua1 | Self::A3aUa1)
    }
}

/// A moment in UTC.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Date {
    /// Year.
    pub year: i32,
    /// 1 to 12.
    pub month: u8,
    /// 1 to 31.
    pub day: u8,
    /// 0 to 23.
    pub hour: u8,
    /// 0 to 59.
    pub minute: u8,
    /// 0 to 59.
    pub second: u8,
}

impl Date {
    /// The typesetter's value; `None` if there is no such moment.
    pub(super) fn datetime(self) -> Option<Datetime> {
        Datetime::from_ymd_hms(self.year, self.month, self.day, self.hour, self.minute, self.second)
    }

    /// The time stamp in the file.
    pub(super) fn timestamp(self) -> Option<Timestamp> {
        self.datetime().map(Timestamp::new_utc)
    }
}
