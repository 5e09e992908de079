//! Conversion to bytes in bulk, written in large pieces.

use crate::binary::Order;
use glam::DVec3;
use std::io::{self, Write};

/// Bytes per write.
const CAPACITY: usize = 1 << 20;

/// Collects converted values and writes them in pieces of [`CAPACITY`].
pub struct ByteSink<'a> {
    out: &'a mut dyn Write,
    buffer: Box<[u8]>,
    used: usize,
}

impl<'a> ByteSink<'a> {
    pub fn new(out: &'a mut dyn Write) -> Self {
        let buffer = vec![0; CAPACITY].into_boxed_slice();
        Self {
            out,
            buffer,
            used: 0,
        }
    }

    /// Writes what is still collected, and flushes.
    pub fn finish(mut self) -> io::Result<()> {
        self.drain()?;
        self.out.flush()
    }

    fn drain(&mut self) -> io::Result<()> {
        self.out.write_all(&self.buffer[..self.used])?;
        self.used = 0;
        Ok(())
    }

    /// Appends bytes as they are.
    pub fn bytes(&mut self, mut bytes: &[u8]) -> io::Result<()> {
        while !bytes.is_empty() {
            let free = &mut self.buffer[self.used..];
            let step = free.len().min(bytes.len());
            free[..step].copy_from_slice(&bytes[..step]);
            self.used += step;
            bytes = &bytes[step..];
            if self.used == CAPACITY {
                self.drain()?;
            }
        }
        Ok(())
    }

    /// Appends formatted text.
    pub fn write_fmt(&mut self, text: std::fmt::Arguments<'_>) -> io::Result<()> {
        Write::write_fmt(&mut Formatted(self), text)
    }

    /// Appends text.
    pub fn text(&mut self, text: &str) -> io::Result<()> {
        self.bytes(text.as_bytes())
    }

    /// Appends records of `N` bytes, each converted from one value.
    fn records<T: Copy, const N: usize>(
        &mut self,
        values: &[T],
        convert: impl Fn(T) -> [u8; N],
    ) -> io::Result<()> {
        let mut values = values;
        while !values.is_empty() {
            if CAPACITY - self.used < N {
                self.drain()?;
            }
            let (free, _) = self.buffer[self.used..].as_chunks_mut::<N>();
            let step = free.len().min(values.len());
            for (to, &from) in free.iter_mut().zip(&values[..step]) {
                *to = convert(from);
            }
            self.used += step * N;
            values = &values[step..];
        }
        Ok(())
    }

    /// Appends 32-bit integers.
    pub fn u32s(&mut self, order: Order, values: &[u32]) -> io::Result<()> {
        match order {
            Order::Little => self.records(values, u32::to_le_bytes),
            Order::Big => self.records(values, u32::to_be_bytes),
        }
    }

    /// Appends numbers as little-endian integers of 64 bits, or of 32, which must suffice.
    pub fn integers<T: Copy + Into<u64>>(&mut self, wide: bool, values: &[T]) -> io::Result<()> {
        if wide {
            self.records(values, |v| v.into().to_le_bytes())
        } else {
            self.records(values, |v| (v.into() as u32).to_le_bytes())
        }
    }

    /// Appends points, three 64-bit floats each.
    pub fn points(&mut self, order: Order, points: &[DVec3]) -> io::Result<()> {
        let numbers: &[f64] = bytemuck::cast_slice(points);
        match order {
            Order::Little => self.records(numbers, f64::to_le_bytes),
            Order::Big => self.records(numbers, f64::to_be_bytes),
        }
    }

    /// Appends records of big-endian 32-bit integers: `N - 1` ids after their number.
    pub fn counted<const I: usize, const N: usize>(&mut self, ids: &[[u32; I]]) -> io::Result<()> {
        const { assert!(N == 4 * (I + 1)) };
        self.records(ids, |ids| {
            let mut record = [0; N];
            let (words, _) = record.as_chunks_mut::<4>();
            words[0] = (I as u32).to_be_bytes();
            for (to, id) in words[1..].iter_mut().zip(ids) {
                *to = id.to_be_bytes();
            }
            record
        })
    }

    /// Appends the same bytes `count` times.
    pub fn repeat<const N: usize>(&mut self, record: [u8; N], count: u64) -> io::Result<()> {
        let block = [(); 512];
        let mut left = count;
        while left > 0 {
            let step = left.min(block.len() as u64) as usize;
            self.records(&block[..step], |()| record)?;
            left -= step as u64;
        }
        Ok(())
    }
}

/// Takes formatted text piece by piece.
struct Formatted<'a, 'b>(&'a mut ByteSink<'b>);

impl Write for Formatted<'_, '_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.bytes(bytes)?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_pass_the_buffer_border_unharmed() {
        let values: Vec<u32> = (0..CAPACITY as u32).collect();
        let points: Vec<DVec3> = (0..50_000).map(|i| DVec3::splat(f64::from(i))).collect();
        let mut out = Vec::new();
        let mut sink = ByteSink::new(&mut out);
        sink.text("abc").unwrap();
        sink.u32s(Order::Big, &values).unwrap();
        sink.points(Order::Little, &points).unwrap();
        sink.repeat([7, 8, 9], 1_000_000).unwrap();
        sink.finish().unwrap();
        let mut expected = b"abc".to_vec();
        expected.extend(values.iter().flat_map(|v| v.to_be_bytes()));
        for p in &points {
            expected.extend(p.to_array().iter().flat_map(|x| x.to_le_bytes()));
        }
        expected.extend([7, 8, 9].repeat(1_000_000));
        assert!(out == expected);
    }
}
