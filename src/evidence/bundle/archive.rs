//! A ZIP archive in one canonical form (PKWARE APPNOTE 6.3): files sorted by name, stored, dated 1980-01-01, no comment, no
//! extra field. Written by hand, so that the same content gives the same bytes whatever library comes and goes, and
//! so that a reader can account for every byte: [`read`] writes what it read again and compares.

use std::collections::BTreeMap;

/// What a file that is no canonical archive has wrong with it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The file in the archive whose bytes or header are concerned, or [`DIRECTORY`].
    pub part: String,
    /// What is wrong.
    pub message: String,
}

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
pub fn write(files: &BTreeMap<String, Vec<u8>>) -> Result<Vec<u8>, String> {
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
#[must_use]
pub fn read(bytes: &[u8]) -> (BTreeMap<String, Vec<u8>>, Vec<Fault>) {
    let mut faults = Vec::new();
    let files = match entries(bytes, &mut faults) {
        Ok(files) => files,
        Err(message) => {
            faults.push(Fault { part: DIRECTORY.to_owned(), message });
            return (BTreeMap::new(), faults);
        }
    };
    match write(&files) {
        Ok(again) if again == bytes => {}
        Ok(again) => faults.extend(difference(&files, &again, bytes)),
        Err(message) => faults.push(Fault { part: DIRECTORY.to_owned(), message }),
    }
    (files, faults)
}

/// The files that the directory lists.
fn entries(bytes: &[u8], faults: &mut Vec<Fault>) -> Result<BTreeMap<String, Vec<u8>>, String> {
    let end = bytes.len().checked_sub(22).ok_or("too short for an archive")?;
    if number(bytes, end, 4) != Some(END as usize) {
        return Err("it does not end as an archive of this tool does".to_owned());
    }
    let get = |at, width| number(bytes, at, width).ok_or_else(|| "cut off".to_owned());
    let (count, start) = (get(end + 10, 2)?, get(end + 16, 4)?);
    let mut files = BTreeMap::new();
    let mut at = start;
    for _ in 0..count {
        if get(at, 4)? != CENTRAL as usize {
            return Err(format!("no entry at byte {at}"));
        }
        let (length, stored, offset) = (get(at + 28, 2)?, get(at + 20, 4)?, get(at + 42, 4)?);
        let name = bytes.get(at + 46..at + 46 + length).ok_or("cut off")?;
        let name = String::from_utf8(name.to_vec()).map_err(|_| "a name is not UTF-8".to_owned())?;
        at += 46 + length;
        // The name in the local header is as long; where it is not, the comparison finds it.
        let from = offset + 30 + length;
        let Some(data) = from.checked_add(stored).and_then(|to| bytes.get(from..to)) else {
            faults.push(Fault { part: name, message: "it reaches beyond the archive".to_owned() });
            continue;
        };
        if files.insert(name.clone(), data.to_vec()).is_some() {
            faults.push(Fault { part: name, message: "it is there twice".to_owned() });
        }
    }
    Ok(files)
}

fn number(bytes: &[u8], at: usize, width: usize) -> Option<usize> {
    let bytes = bytes.get(at..at.checked_add(width)?)?;
    Some(bytes.iter().rev().fold(0, |value, byte| value << 8 | usize::from(*byte)))
}

/// Where `found` first differs from the canonical form of its files.
fn difference(files: &BTreeMap<String, Vec<u8>>, canonical: &[u8], found: &[u8]) -> Option<Fault> {
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
        assert_eq!(read(&bytes), (files.clone(), Vec::new()));
        let mut other = zip::ZipArchive::new(std::io::Cursor::new(&bytes)).expect("an archive");
        assert_eq!(other.len(), files.len());
        for (name, content) in &files {
            let mut found = Vec::new();
            std::io::Read::read_to_end(&mut other.by_name(name).expect("there"), &mut found).expect("readable");
            assert_eq!(found, *content);
        }
    }
}
