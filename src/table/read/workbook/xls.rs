//! Measures a `.xls` before the library that reads it lays its sheets out: that library trusts the dimensions, the
//! offsets and the cells that a file states. The records of a workbook (MS-XLS 2.4) are walked here in its stream of the
//! compound file (MS-CFB 2), and a file that is irregular or fills more than it should is refused.

/// How many cells the sheets may span, and how much text their cells may copy from the table of strings.
const SPAN: u64 = 1 << 22;
const COPIED: u64 = 1 << 30;
/// The longest text that a cell can hold, in bytes.
const TEXT: u64 = 3 * 65_536;
/// Ends a chain of sectors; greater numbers stand for sectors that hold nothing.
const LAST: u32 = 0xFFFF_FFFE;

/// Refuses what would not be read in bounded memory.
pub(super) fn measure(bytes: &[u8]) -> Result<(), String> {
    let stream = Compound::open(bytes).and_then(|file| file.workbook()).ok_or("its structure is damaged")?;
    let mut measure = Measure { stream: &stream, ..Measure::default() };
    measure.walk().ok_or("its records are damaged")?;
    let regular = measure
        .sheets
        .iter()
        .enumerate()
        .all(|(index, at)| measure.begins.contains(at) && !measure.sheets[..index].contains(at));
    if !regular {
        return Err("its sheets do not begin where it says".to_owned());
    }
    if measure.span > SPAN || measure.copies.saturating_mul(measure.strings.min(TEXT)) > COPIED {
        return Err("its sheets fill more than can be read".to_owned());
    }
    Ok(())
}

fn u16_at(bytes: &[u8], at: usize) -> Option<u16> {
    Some(u16::from_le_bytes(bytes.get(at..at.checked_add(2)?)?.try_into().ok()?))
}

fn u32_at(bytes: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_le_bytes(bytes.get(at..at.checked_add(4)?)?.try_into().ok()?))
}

/// A compound file.
struct Compound<'a> {
    bytes: &'a [u8],
    shift: u32,
    /// For each sector the next of its chain.
    next: Vec<u32>,
}

impl<'a> Compound<'a> {
    fn open(bytes: &'a [u8]) -> Option<Self> {
        let shift = u32::from(u16_at(bytes, 30)?);
        if !matches!(shift, 9 | 12) {
            return None;
        }
        let mut file = Self { bytes, shift, next: Vec::new() };
        let mut tables: Vec<u32> = (0..109).filter_map(|i| u32_at(bytes, 76 + 4 * i)).collect();
        let mut more = u32_at(bytes, 68)?;
        let per_sector = (1 << shift) / 4;
        while more < LAST {
            let sector = file.sector(more)?;
            tables.extend((0..per_sector - 1).filter_map(|i| u32_at(sector, 4 * i)));
            more = u32_at(sector, 4 * (per_sector - 1))?;
            if tables.len() > file.sectors() + 109 + per_sector {
                return None;
            }
        }
        for table in tables.into_iter().filter(|table| *table < LAST) {
            let sector = file.sector(table)?;
            file.next.extend((0..per_sector).filter_map(|i| u32_at(sector, 4 * i)));
            if file.next.len() > 2 * (file.sectors() + per_sector) {
                return None;
            }
        }
        Some(file)
    }

    fn sectors(&self) -> usize {
        self.bytes.len() >> self.shift
    }

    fn sector(&self, index: u32) -> Option<&'a [u8]> {
        let start = (index as usize).checked_add(1)?.checked_mul(1 << self.shift)?;
        let rest = self.bytes.get(start..).filter(|rest| !rest.is_empty())?;
        Some(&rest[..rest.len().min(1 << self.shift)])
    }

    /// What the chain that begins at `first` holds.
    fn chain(&self, first: u32) -> Option<Vec<u8>> {
        let mut out = Vec::new();
        let mut at = first;
        while at < LAST {
            out.extend_from_slice(self.sector(at)?);
            if out.len() > self.bytes.len() {
                return None;
            }
            at = *self.next.get(at as usize)?;
        }
        Some(out)
    }

    /// The stream of the workbook.
    fn workbook(&self) -> Option<Vec<u8>> {
        let folder = self.chain(u32_at(self.bytes, 48)?)?;
        let entry = |wanted: &str| {
            folder.chunks_exact(128).find(|entry| {
                let units = entry[..64].chunks_exact(2).map(|unit| u16::from_le_bytes([unit[0], unit[1]]));
                let name: Vec<u16> = units.take_while(|unit| *unit != 0).collect();
                String::from_utf16_lossy(&name).eq_ignore_ascii_case(wanted)
            })
        };
        let found = entry("Workbook").or_else(|| entry("Book"))?;
        let (first, size) = (u32_at(found, 116)?, u32_at(found, 120)? as usize);
        let mut stream = if size < u32_at(self.bytes, 56)? as usize {
            self.small(&folder, first, size)?
        } else {
            self.chain(first)?
        };
        stream.truncate(size);
        Some(stream)
    }

    /// A stream of less than a sector or few: it lies in pieces of 64 bytes in the stream of the root.
    fn small(&self, folder: &[u8], first: u32, size: usize) -> Option<Vec<u8>> {
        let pieces = self.chain(u32_at(folder, 116)?)?;
        let next = self.chain(u32_at(self.bytes, 60)?)?;
        let mut out = Vec::new();
        let mut at = first;
        while at < LAST && out.len() < size {
            let start = (at as usize).checked_mul(64)?;
            let rest = pieces.get(start..)?;
            out.extend_from_slice(&rest[..rest.len().min(64)]);
            at = u32_at(&next, (at as usize).checked_mul(4)?)?;
        }
        Some(out)
    }
}

/// What the records of a workbook amount to.
#[derive(Default)]
struct Measure<'a> {
    stream: &'a [u8],
    /// Where parts begin, and where sheets are said to.
    begins: Vec<u32>,
    sheets: Vec<u32>,
    /// How many cells the parts span, how many copy a string, and how long the table of strings is.
    span: u64,
    copies: u64,
    strings: u64,
    /// The first and the last row and column of this part.
    part: Option<[u32; 4]>,
}

impl Measure<'_> {
    fn walk(&mut self) -> Option<()> {
        let (mut at, mut last) = (0, 0);
        while at + 4 <= self.stream.len() {
            let kind = u16_at(self.stream, at)?;
            let length = usize::from(u16_at(self.stream, at + 2)?);
            // Streams are filled up to a sector with nothing.
            let Some(data) = self.stream.get(at + 4..at + 4 + length) else { break };
            self.record(kind, last, u32::try_from(at).ok()?, data)?;
            if kind != CONTINUE {
                last = kind;
            }
            at += 4 + length;
        }
        self.close();
        Some(())
    }

    fn record(&mut self, kind: u16, before: u16, at: u32, data: &[u8]) -> Option<()> {
        match kind {
            // BOF.
            0x0809 => {
                self.close();
                self.begins.push(at);
            }
            // BOUNDSHEET.
            0x0085 => self.sheets.push(u32_at(data, 0)?),
            // DIMENSIONS: of 16 bits for a row in old files, of 32 in newer ones.
            0x0200 => {
                let [top, bottom, left, right] = match data.len() {
                    10 => [u16_at(data, 0)?, u16_at(data, 2)?, u16_at(data, 4)?, u16_at(data, 6)?].map(u32::from),
                    14 | 16 => [u32_at(data, 0)?, u32_at(data, 4)?, u16_at(data, 8)?.into(), u16_at(data, 10)?.into()],
                    _ => return None,
                };
                // A first column that cannot be is taken for the first of all.
                let left = if left > 0xFF || right < left { 0 } else { left };
                if bottom > 0 && right > 0 {
                    self.span = self.span.saturating_add(span([top, bottom - 1, left, right - 1])?);
                }
            }
            // NUMBER, LABEL, RSTRING, BOOLERR, RK, FORMULA.
            0x0203 | 0x0204 | 0x00D6 | 0x0205 | 0x027E | 0x0006 => self.cell(data, u16_at(data, 2)?)?,
            // LABELSST.
            0x00FD => {
                self.copies += 1;
                self.cell(data, u16_at(data, 2)?)?;
            }
            // MULRK: its last column stands at its end.
            0x00BD => {
                self.cell(data, u16_at(data, 2)?)?;
                self.cell(data, u16_at(data, data.len().checked_sub(2)?)?)?;
            }
            // SST.
            0x00FC => self.strings += data.len() as u64,
            CONTINUE if before == 0x00FC => self.strings += data.len() as u64,
            _ => {}
        }
        Some(())
    }

    /// One more cell, in the row that `data` begins with.
    fn cell(&mut self, data: &[u8], column: u16) -> Option<()> {
        let (row, column) = (u32::from(u16_at(data, 0)?), u32::from(column));
        let [top, bottom, left, right] = self.part.unwrap_or([row, row, column, column]);
        self.part = Some([top.min(row), bottom.max(row), left.min(column), right.max(column)]);
        Some(())
    }

    /// Ends a part: its cells are laid out once, and their formulas once more.
    fn close(&mut self) {
        let area = self.part.take().and_then(span).unwrap_or(0);
        self.span = self.span.saturating_add(2 * area);
    }
}

const CONTINUE: u16 = 0x003C;

/// How many cells lie between the first and the last row and column.
fn span([top, bottom, left, right]: [u32; 4]) -> Option<u64> {
    let rows = u64::from(bottom.checked_sub(top)?) + 1;
    let columns = u64::from(right.checked_sub(left)?) + 1;
    Some(rows * columns)
}
