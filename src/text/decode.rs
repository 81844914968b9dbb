//! Bytes to text: a byte order mark decides, then UTF-8, then the likeliest old encoding.

use encoding_rs::{UTF_16BE, UTF_16LE, WINDOWS_1252};

/// How bytes were read as text.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub enum Encoding {
    /// UTF-8, with or without a byte order mark.
    #[default]
    Utf8,
    /// UTF-16, little endian.
    Utf16Le,
    /// UTF-16, big endian.
    Utf16Be,
    /// Not UTF-8; read as the named encoding, which is a guess.
    Guessed(&'static str),
    /// No text: what the bytes look like.
    Binary(&'static str),
}

impl Encoding {
    /// The name as the report prints it.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Utf8 => "UTF-8",
            Self::Utf16Le => "UTF-16LE",
            Self::Utf16Be => "UTF-16BE",
            Self::Guessed(name) | Self::Binary(name) => name,
        }
    }
}

/// Decoded text and how it was read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Decoded {
    /// The text without its byte order mark; empty where the bytes are no text.
    pub text: String,
    /// How it was read.
    pub encoding: Encoding,
}

/// Reads `bytes` as text. Never fails: bytes that are no text give [`Encoding::Binary`] and an empty text.
#[must_use]
pub fn decode(bytes: &[u8]) -> Decoded {
    if let Some(rest) = bytes.strip_prefix(b"\xEF\xBB\xBF") {
        return utf8_or_guess(rest);
    }
    if bytes.starts_with(b"\xFF\xFE") {
        let (text, _) = UTF_16LE.decode_with_bom_removal(bytes);
        return Decoded { text: text.into_owned(), encoding: Encoding::Utf16Le };
    }
    if bytes.starts_with(b"\xFE\xFF") {
        let (text, _) = UTF_16BE.decode_with_bom_removal(bytes);
        return Decoded { text: text.into_owned(), encoding: Encoding::Utf16Be };
    }
    if let Some(kind) = binary(bytes) {
        return Decoded { text: String::new(), encoding: Encoding::Binary(kind) };
    }
    utf8_or_guess(bytes)
}

fn utf8_or_guess(bytes: &[u8]) -> Decoded {
    if let Ok(text) = std::str::from_utf8(bytes) {
        return Decoded { text: text.to_owned(), encoding: Encoding::Utf8 };
    }
    let mut detector = chardetng::EncodingDetector::new(chardetng::Iso2022JpDetection::Deny);
    detector.feed(bytes, true);
    let guess = detector.guess(None, chardetng::Utf8Detection::Deny);
    let (text, _, bad) = guess.decode(bytes);
    if bad {
        // Windows-1252 maps every byte, so nothing is lost even where the guess was wrong.
        let (text, _, _) = WINDOWS_1252.decode(bytes);
        return Decoded { text: text.into_owned(), encoding: Encoding::Guessed(WINDOWS_1252.name()) };
    }
    Decoded { text: text.into_owned(), encoding: Encoding::Guessed(guess.name()) }
}

/// What the bytes look like, if they are no text: a known signature, a zero byte near the start, or many control characters.
fn binary(bytes: &[u8]) -> Option<&'static str> {
    const SIGNATURES: [(&[u8], &str); 5] = [
        (b"PK\x03\x04", "a ZIP archive"),
        (b"\x89PNG", "a PNG picture"),
        (b"\xD0\xCF\x11\xE0", "an OLE compound file"),
        (b"MZ", "a Windows program"),
        (b"%PDF", "a PDF file"),
    ];
    let signature = SIGNATURES.iter().find(|(magic, _)| bytes.starts_with(magic)).map(|(_, name)| *name);
    let head = &bytes[..bytes.len().min(8192)];
    let zero = head.contains(&0);
    // Text holds hardly any control characters besides tabs, line ends, form feeds and the end mark of DOS.
    let control = head.iter().filter(|byte| **byte < 32 && !matches!(byte, 9..=13 | 26 | 27)).count();
    match signature {
        Some(name) if zero || name != "a Windows program" => Some(name),
        _ if zero || control > head.len() / 32 => Some("binary data"),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_byte_order_mark_is_not_text() {
        assert_eq!(decode(b"\xEF\xBB\xBFVAR").text, "VAR");
        assert_eq!(decode(b"\xFF\xFEV\0A\0").text, "VA");
        assert_eq!(decode(b"\xFE\xFF\0V\0A").text, "VA");
    }

    #[test]
    fn an_old_encoding_is_a_guess_that_loses_nothing() {
        let decoded = decode(b"(* Zylinder f\xFCr \xD6lpumpe, Temperatur in \xB0C *)");
        assert_eq!(decoded.text, "(* Zylinder für Ölpumpe, Temperatur in °C *)");
        assert!(matches!(decoded.encoding, Encoding::Guessed(_)));
    }

    #[test]
    fn a_zero_byte_means_no_text() {
        assert_eq!(decode(b"PROGRAM\0\x01\x02").encoding, Encoding::Binary("binary data"));
        assert_eq!(decode(b"\x01\xE7\x54\x85\xC6\x6A\x1C\x7E\xD4").encoding, Encoding::Binary("binary data"));
        assert_eq!(decode(b"PK\x03\x04rest").encoding, Encoding::Binary("a ZIP archive"));
    }
}
