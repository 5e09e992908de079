//! Compressed arrays, kept in a temporary file until their sizes are known.

use flate2::{Compress, Compression, FlushCompress, Status};
use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};

/// Bytes that are compressed together: twice what zlib looks back, so that little is lost at borders.
/// VTK's own writers use 32 KiB.
const BLOCK: usize = 1 << 16;
/// Where time and size balance for arrays of coordinates and ids.
const LEVEL: u32 = 4;

/// An array as VTK's readers want it: the sizes of its compressed blocks, and the blocks.
struct Stored {
    bytes: u64,
    compressed: Vec<u64>,
}

/// Arrays, compressed one after another as zlib streams.
pub struct Spool {
    file: File,
    arrays: Vec<Stored>,
    block: Vec<u8>,
    output: Vec<u8>,
    compress: Compress,
}

impl Spool {
    /// No arrays yet.
    pub fn new() -> io::Result<Self> {
        Ok(Self {
            file: tempfile::tempfile()?,
            arrays: Vec::new(),
            block: Vec::with_capacity(BLOCK),
            output: Vec::new(),
            compress: Compress::new(Compression::new(LEVEL), true),
        })
    }

    /// Begins the next array; what is written then belongs to it.
    pub fn begin(&mut self) {
        self.arrays.push(Stored {
            bytes: 0,
            compressed: Vec::new(),
        });
    }

    /// Ends an array. Returns its size in the file, with its header.
    pub fn end(&mut self) -> io::Result<u64> {
        self.pack()?;
        let array = self.arrays.last();
        let sizes = array.map_or(&[][..], |a| &a.compressed);
        Ok(8 * (3 + sizes.len() as u64) + sizes.iter().sum::<u64>())
    }

    fn pack(&mut self) -> io::Result<()> {
        let Some(array) = self.arrays.last_mut().filter(|_| !self.block.is_empty()) else {
            return Ok(());
        };
        array.bytes += self.block.len() as u64;
        self.compress.reset();
        self.output.clear();
        // Room for what cannot be compressed, too.
        self.output
            .reserve(self.block.len() + self.block.len() / 8 + 256);
        let status =
            self.compress
                .compress_vec(&self.block, &mut self.output, FlushCompress::Finish)?;
        if status != Status::StreamEnd {
            return Err(io::Error::other("a block cannot be compressed"));
        }
        self.file.write_all(&self.output)?;
        array.compressed.push(self.output.len() as u64);
        self.block.clear();
        Ok(())
    }

    /// Writes all arrays, each with its header: number of blocks, size of a block, size of the last
    /// one if it is smaller, else 0, and the compressed sizes.
    pub fn write(mut self, out: &mut dyn Write) -> io::Result<()> {
        self.file.seek(SeekFrom::Start(0))?;
        for array in &self.arrays {
            let header = [
                array.compressed.len() as u64,
                BLOCK as u64,
                array.bytes % BLOCK as u64,
            ];
            for number in header.iter().chain(&array.compressed) {
                out.write_all(&number.to_le_bytes())?;
            }
            let size = array.compressed.iter().sum();
            let copied = io::copy(&mut io::Read::take(&self.file, size), out)?;
            if copied != size {
                return Err(io::Error::other("the temporary file is cut off"));
            }
        }
        Ok(())
    }
}

impl Write for Spool {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let step = bytes.len().min(BLOCK - self.block.len());
        self.block.extend_from_slice(&bytes[..step]);
        if self.block.len() == BLOCK {
            self.pack()?;
        }
        Ok(step)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
