//! A ZIP archive in one canonical form (PKWARE APPNOTE 6.3): files sorted by name, stored, dated 1980-01-01, no comment, no
//! extra field. Written by hand, so that the same content gives the same bytes whatever library comes and goes, and
//! so that a reader can account for every byte: [`read`] writes again what it read, and compares.

use std::collections::BTreeMap;

/// What a file that is no canonical archive has wrong with it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The file in the archive whose bytes or header are concerned, or [`DIRECTORY`].
    pub part: String,
    /// What is wrong.
    pub message: String,
}

/// The files of an archive, by name.
pub type Files = BTreeMap<String, Vec<u8>>;

/// The name for the list of files at the end of the archive.
pub const DIRECTORY: &str = "the archive's directory";

const LOCAL: u32 = 0x0403_4b50;
const CENTRAL: u32 = 0x0201_4b50;
const END: u32 = 0x0605_4b50;
/// 1980-01-01, the earliest that the format knows; time 0.
const DATE: u16 = 0x21;
/// Names are UTF-8.
const FLAGS: u16 = 0x0800;
/// Version 1.0 is needed to read it, on the DOS side; written by version 2.0.
const NEEDED: u16 = 10;

/// CRC-32 as ISO 3309 has it.
fn crc32(bytes: &[u8]) -> u32 {
    const TABLE: [u32; 256] = table();
    !bytes.iter().fold(!0, |crc: u32, byte| {
        let index = (crc ^ u32::from(*byte)) & 0xff;
        TABLE[index as usize] ^ (crc >> 8)
    })
}

const fn table() -> [u32; 256] {
    let mut table = [0; 256];
    let mut i = 0;
    while i < 256 {
        let mut value = i as u32;
        let mut bit = 0;
        while bit < 8 {
            value = if value & 1 == 1 { 0xedb8_8320 ^ (value >> 1) } else { value >> 1 };
            bit += 1;
        }
        table[i] = value;
        i += 1;
    }
    table
}

/// The bytes of an archive with `files`, by name.
///
/// # Errors
/// If there are more files or bytes than the format holds without its extension for large archives.
pub fn write(files: &Files) -> Result<Vec<u8>, String> {
    let count = u16::try_from(files.len()).map_err(|_| "more than 65535 files".to_owned())?;
    let (mut out, mut directory) = (Vec::new(), Vec::new());
    for (name, bytes) in files {
        let offset = size(out.len())?;
        let common = common(name, bytes)?;
        out.extend(LOCAL.to_le_bytes());
        out.extend(&common);
        out.extend(0_u16.to_le_bytes());
        out.extend(name.as_bytes());
        out.extend(bytes);
        directory.extend(CENTRAL.to_le_bytes());
        directory.extend(20_u16.to_le_bytes());
        directory.extend(&common);
        // Lengths of extra field and comment, disk, attributes within and without.
        directory.extend([0; 12]);
        directory.extend(offset.to_le_bytes());
        directory.extend(name.as_bytes());
    }
    let start = size(out.len())?;
    let length = size(directory.len())?;
    out.extend(directory);
    size(out.len())?;
    out.extend(END.to_le_bytes());
    out.extend([0; 4]);
    out.extend(count.to_le_bytes());
    out.extend(count.to_le_bytes());
    out.extend(length.to_le_bytes());
    out.extend(start.to_le_bytes());
    out.extend(0_u16.to_le_bytes());
    Ok(out)
}

fn size(length: usize) -> Result<u32, String> {
    u32::try_from(length).map_err(|_| "more than 4 GiB".to_owned())
}

/// What both headers of a file share: from the version needed to the length of the name.
fn common(name: &str, bytes: &[u8]) -> Result<Vec<u8>, String> {
    let length = u16::try_from(name.len()).map_err(|_| format!("the name `{name}` is too long"))?;
    let mut out = Vec::new();
    for value in [NEEDED, FLAGS, 0, 0, DATE] {
        out.extend(value.to_le_bytes());
    }
    for value in [crc32(bytes), size(bytes.len())?, size(bytes.len())?] {
        out.extend(value.to_le_bytes());
    }
    out.extend(length.to_le_bytes());
    Ok(out)
}

/// The files of an archive, as far as they can be told, and everything in which it differs from its canonical form.
///
/// The list of files stands in it twice, before each file and in the directory. Where the two do not agree, that
/// reading counts whose canonical form is nearer to the bytes, so that a fault is found where it is; where both are as near, the one
/// in which `wrong` counts less.
pub fn read(bytes: &[u8], wrong: &dyn Fn(&Files) -> usize) -> (Files, Vec<Fault>) {
    let mut best: Option<((usize, usize), Files, Option<Fault>)> = None;
    for reading in [by_directory(bytes), by_headers(bytes)].into_iter().flatten() {
        let Ok(again) = write(&reading) else { continue };
        let distance = (distance(&again, bytes), wrong(&reading));
        let fault = difference(&reading, &again, bytes);
        if distance.0 == 0 {
            return (reading, Vec::new());
        }
        if best.as_ref().is_none_or(|(known, ..)| distance < *known) {
            best = Some((distance, reading, fault));
        }
    }
    match best {
        Some((_, files, fault)) => (files, fault.into_iter().collect()),
        None => {
            let message = "it is no archive of this tool".to_owned();
            (Files::new(), vec![Fault { part: DIRECTORY.to_owned(), message }])
        }
    }
}

fn distance(a: &[u8], b: &[u8]) -> usize {
    a.iter().zip(b).filter(|(a, b)| a != b).count() + a.len().abs_diff(b.len())
}

/// The files that the directory lists.
fn by_directory(bytes: &[u8]) -> Option<Files> {
    let end = bytes.len().checked_sub(22)?;
    let (count, start) = (number(bytes, end + 10, 2)?, number(bytes, end + 16, 4)?);
    let mut files = Files::new();
    let mut at = start;
    for _ in 0..count {
        let (length, stored, offset) =
            (number(bytes, at + 28, 2)?, number(bytes, at + 20, 4)?, number(bytes, at + 42, 4)?);
        let name = String::from_utf8(slice(bytes, at + 46, length)?.to_vec()).ok()?;
        at += 46 + length;
        let data = slice(bytes, offset + 30 + length, stored)?;
        files.insert(name, data.to_vec());
    }
    Some(files)
}

/// The files as their own headers tell, one behind the other.
fn by_headers(bytes: &[u8]) -> Option<Files> {
    let mut files = Files::new();
    let mut at = 0;
    // The first bytes that begin no file begin the directory; a header whose mark was changed is passed over by its place.
    while number(bytes, at, 4)? != CENTRAL as usize && number(bytes, at, 4)? != END as usize {
        let (length, stored) = (number(bytes, at + 26, 2)?, number(bytes, at + 22, 4)?);
        let name = String::from_utf8(slice(bytes, at + 30, length)?.to_vec()).ok()?;
        let data = slice(bytes, at + 30 + length, stored)?;
        files.insert(name, data.to_vec());
        at += 30 + length + stored;
    }
    Some(files)
}

fn slice(bytes: &[u8], from: usize, length: usize) -> Option<&[u8]> {
    bytes.get(from..from.checked_add(length)?)
}

fn number(bytes: &[u8], at: usize, width: usize) -> Option<usize> {
    let bytes = bytes.get(at..at.checked_add(width)?)?;
    Some(bytes.iter().rev().fold(0, |value, byte| value << 8 | usize::from(*byte)))
}

/// Where `found` first differs from the canonical form of its files.
fn difference(files: &Files, canonical: &[u8], found: &[u8]) -> Option<Fault> {
    let at = canonical.iter().zip(found).position(|(a, b)| a != b);
    let at = at.or_else(|| (canonical.len() != found.len()).then(|| canonical.len().min(found.len())))?;
    let mut start = 0;
    for (name, bytes) in files {
        let header = start + 30 + name.len();
        if at < header + bytes.len() {
            let message = if at >= start + 14 && at < start + 18 {
                "its bytes do not have the checksum that the archive states".to_owned()
            } else {
                format!("its header in the archive was changed, at byte {at}")
            };
            return Some(Fault { part: name.clone(), message });
        }
        start = header + bytes.len();
    }
    Some(Fault { part: DIRECTORY.to_owned(), message: format!("it was changed, at byte {at}") })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_checksum_is_that_of_the_standard() {
        // The check value of CRC-32/ISO-HDLC.
        assert_eq!(crc32(b"123456789"), 0xcbf4_3926);
    }

    #[test]
    fn what_was_written_reads_back_and_others_read_it_too() {
        let files: BTreeMap<String, Vec<u8>> =
            [("a/é.txt", b"one".to_vec()), ("b.bin", vec![0, 255, 80, 75, 5, 6]), ("empty", Vec::new())]
                .map(|(name, bytes)| (name.to_owned(), bytes))
                .into();
        let bytes = write(&files).expect("small");
        assert_eq!(read(&bytes, &|_| 0), (files.clone(), Vec::new()));
        let mut other = zip::ZipArchive::new(std::io::Cursor::new(&bytes)).expect("an archive");
        assert_eq!(other.len(), files.len());
        for (name, content) in &files {
            let mut found = Vec::new();
            std::io::Read::read_to_end(&mut other.by_name(name).expect("there"), &mut found).expect("readable");
            assert_eq!(found, *content);
        }
    }
}
