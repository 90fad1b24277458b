//! A million rows, in the memory that the documentation states.

use std::io::{BufReader, Read};

use fit::data::{Format, read_from};

/// Writes a table with a header and `rows` rows, as it is read.
struct Table {
    rows: u64,
    written: u64,
    line: Vec<u8>,
    from: usize,
}

impl Read for Table {
    fn read(&mut self, out: &mut [u8]) -> std::io::Result<usize> {
        use std::io::Write;
        if self.from == self.line.len() {
            if self.written > self.rows {
                return Ok(0);
            }
            self.line.clear();
            self.from = 0;
            let row = self.written;
            if row == 0 {
                self.line.extend(b"Radius [um],Load [mN]\n");
            } else {
                let load = row % 1000;
                writeln!(self.line, "{row}.25,{load}")?;
            }
            self.written += 1;
        }
        let bytes = &self.line[self.from..];
        let count = bytes.len().min(out.len());
        out[..count].copy_from_slice(&bytes[..count]);
        self.from += count;
        Ok(count)
    }
}

#[test]
fn a_million_rows_take_the_memory_of_their_points() {
    /// The list has just grown to twice a power of two, which takes the most for each row.
    const ROWS: u64 = (1 << 20) + 10_000;
    /// Bytes for each row while the list grows: the old list, 32, and the new one, up to 64.
    const BYTES: u64 = 96;
    let table = Table {
        rows: ROWS,
        written: 0,
        line: Vec::new(),
        from: 0,
    };
    let mut last = None;
    let memory = allocation_counter::measure(|| {
        let reading = read_from(BufReader::new(table), "large", &Format::default());
        let points = reading.expect("a sound table").measurement.points;
        last = Some((points.len() as u64, points[points.len() - 1]));
    });
    let (count, point) = last.expect("it has been read");
    assert_eq!((count, point.line), (ROWS, ROWS + 1));
    assert_eq!(point.abscissa, (ROWS as f64 + 0.25) * 1e-6);
    let a_row = memory.bytes_max / ROWS;
    println!("{a_row} bytes a row at most");
    assert!(a_row <= BYTES, "{a_row}");
}
