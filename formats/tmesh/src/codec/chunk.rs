//! File header, chunk headers and trailers, end marker. `SPEC.md`, sections 2 and 3.

use super::array;
use crate::DecodeError;
use bytemuck::Pod;
use byteorder::{ByteOrder, LittleEndian as LE};
use std::io::{self, Read, Write};

/// The first eight bytes: a byte with the high bit set, the name, and a line end that text-mode
/// transfers would change.
pub const MAGIC: [u8; 8] = *b"\x89TMESH\r\n";
/// Readers refuse documents with another major version.
pub const VERSION_MAJOR: u16 = 1;
/// Raised when chunks are added that older readers may skip.
pub const VERSION_MINOR: u16 = 0;

const FILE_HEADER: usize = 16;
const CHUNK_HEADER: usize = 24;
const TRAILER: usize = 8;
const END: [u8; 4] = *b"END ";

/// What the file says of one chunk.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChunkInfo {
    /// Four ASCII characters; the first is lower case when readers may skip the chunk.
    pub id: [u8; 4],
    /// Template index, or 0 for chunks of the document.
    pub scope: u32,
    /// Bytes of payload.
    pub length: u64,
    /// Where the chunk's header begins, bytes from the start of the document.
    pub offset: u64,
    /// Whether this version understood it.
    pub known: bool,
}

impl ChunkInfo {
    /// The id as text.
    pub fn name(&self) -> String {
        self.id.escape_ascii().to_string()
    }

    /// Checks that the chunk belongs to the document, not to a template.
    pub(super) fn of_document(&self) -> Result<(), DecodeError> {
        match self.scope {
            0 => Ok(()),
            scope => Err(self.bad(format!("its scope is {scope}, and must be 0"))),
        }
    }

    pub(super) fn bad(&self, reason: impl Into<String>) -> DecodeError {
        DecodeError::BadChunk {
            id: self.name(),
            offset: self.offset,
            reason: reason.into(),
        }
    }
}

fn padding(length: u64) -> usize {
    (length.wrapping_neg() % 8) as usize
}

/// Writes chunks one after the other.
pub struct ChunkWriter<W: Write> {
    out: W,
    offset: u64,
    chunks: u64,
}

impl<W: Write> ChunkWriter<W> {
    /// Writes the file header.
    pub fn begin(mut out: W) -> io::Result<Self> {
        let mut header = [0; FILE_HEADER];
        header[..8].copy_from_slice(&MAGIC);
        LE::write_u16(&mut header[8..10], VERSION_MAJOR);
        LE::write_u16(&mut header[10..12], VERSION_MINOR);
        let crc = crc32fast::hash(&header[..12]);
        LE::write_u32(&mut header[12..16], crc);
        out.write_all(&header)?;
        Ok(Self {
            out,
            offset: FILE_HEADER as u64,
            chunks: 0,
        })
    }

    /// Writes a chunk of `length` bytes, whose payload `fill` writes in as many pieces as it likes.
    ///
    /// The length comes first and the checksum last, so a payload larger than memory can be
    /// streamed.
    ///
    /// # Errors
    /// Fails when writing fails, or with `InvalidData` when `fill` writes another number of bytes.
    pub fn chunk(
        &mut self,
        id: [u8; 4],
        scope: u32,
        length: u64,
        fill: impl FnOnce(&mut PayloadWriter<'_, W>) -> io::Result<()>,
    ) -> io::Result<()> {
        let mut header = [0; CHUNK_HEADER];
        header[..4].copy_from_slice(&id);
        LE::write_u32(&mut header[4..8], scope);
        LE::write_u64(&mut header[8..16], length);
        let crc = crc32fast::hash(&header[..16]);
        LE::write_u32(&mut header[16..20], crc);
        self.out.write_all(&header)?;
        let mut payload = PayloadWriter {
            out: &mut self.out,
            hasher: crc32fast::Hasher::new(),
            written: 0,
        };
        fill(&mut payload)?;
        if payload.written != length {
            return Err(io::Error::new(
                io::ErrorKind::InvalidData,
                format!("a chunk of {length} bytes was given {}", payload.written),
            ));
        }
        let crc = payload.hasher.finalize();
        let pad = padding(length);
        let mut tail = [0; 7 + TRAILER];
        LE::write_u32(&mut tail[pad..pad + 4], crc);
        self.out.write_all(&tail[..pad + TRAILER])?;
        self.offset += (CHUNK_HEADER + pad + TRAILER) as u64 + length;
        self.chunks += 1;
        Ok(())
    }

    /// Writes a chunk whose payload is one array.
    pub fn array<T: Pod>(&mut self, id: [u8; 4], scope: u32, data: &[T]) -> io::Result<()> {
        self.chunk(id, scope, size_of_val(data) as u64, |p| p.array(data))
    }

    /// Writes the end marker and flushes.
    pub fn finish(mut self) -> io::Result<()> {
        let mut payload = [0; 16];
        LE::write_u64(&mut payload[..8], self.chunks);
        LE::write_u64(&mut payload[8..], self.offset);
        self.chunk(END, 0, 16, |p| p.bytes(&payload))?;
        self.out.flush()
    }
}

/// Takes the payload of one chunk.
pub struct PayloadWriter<'a, W: Write> {
    out: &'a mut W,
    hasher: crc32fast::Hasher,
    written: u64,
}

impl<W: Write> PayloadWriter<'_, W> {
    /// Appends bytes.
    pub fn bytes(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.hasher.update(bytes);
        self.written += bytes.len() as u64;
        self.out.write_all(bytes)
    }

    /// Appends an array of plain values, little-endian.
    pub fn array<T: Pod>(&mut self, data: &[T]) -> io::Result<()> {
        array::with_little_endian(data, |bytes| self.bytes(bytes))
    }

    /// Appends zeros up to the next multiple of eight bytes.
    pub fn align(&mut self) -> io::Result<()> {
        let pad = padding(self.written);
        self.bytes(&[0; 8][..pad])
    }
}

/// Reads chunks one after the other.
pub(super) struct ChunkReader<R: Read> {
    input: R,
    offset: u64,
    chunks: Vec<ChunkInfo>,
}

impl<R: Read> ChunkReader<R> {
    pub fn begin(input: R) -> Result<Self, DecodeError> {
        let mut reader = Self {
            input,
            offset: 0,
            chunks: Vec::new(),
        };
        let mut header = [0; FILE_HEADER];
        let got = reader.fill(&mut header)?;
        if got == 0 {
            return Err(DecodeError::Empty);
        }
        let magic = &header[..got.min(8)];
        if magic != &MAGIC[..magic.len()] {
            return Err(DecodeError::BadMagic {
                found: magic.to_vec(),
            });
        }
        if got < FILE_HEADER {
            return Err(reader.truncated("inside the file header"));
        }
        let (stored, computed) = (LE::read_u32(&header[12..]), crc32fast::hash(&header[..12]));
        if stored != computed {
            let what = "the file header".to_owned();
            return Err(DecodeError::Checksum {
                what,
                offset: 0,
                stored,
                computed,
            });
        }
        let found = LE::read_u16(&header[8..]);
        if found != VERSION_MAJOR {
            return Err(DecodeError::Version {
                found,
                supported: VERSION_MAJOR,
            });
        }
        Ok(reader)
    }

    /// The next chunk's header, or `None` at the end marker (which is verified).
    pub fn next_chunk(&mut self) -> Result<Option<ChunkInfo>, DecodeError> {
        let offset = self.offset;
        let mut header = [0; CHUNK_HEADER];
        self.exact(&mut header, || {
            "where a chunk or the end marker should follow".to_owned()
        })?;
        let (stored, computed) = (LE::read_u32(&header[16..]), crc32fast::hash(&header[..16]));
        if stored != computed {
            let what = "a chunk header".to_owned();
            return Err(DecodeError::Checksum {
                what,
                offset,
                stored,
                computed,
            });
        }
        let info = ChunkInfo {
            id: [header[0], header[1], header[2], header[3]],
            scope: LE::read_u32(&header[4..]),
            length: LE::read_u64(&header[8..]),
            offset,
            known: true,
        };
        if header[20..] != [0; 4] {
            return Err(info.bad("the last four bytes of its header are not zero"));
        }
        if info.id == END {
            info.of_document()?;
            let payload: Vec<u64> = self.array(&info)?;
            if payload != [self.chunks.len() as u64, offset] {
                return Err(info.bad(format!(
                    "it counts {payload:?} (chunks, bytes), but {} chunks in {offset} bytes were read",
                    self.chunks.len()
                )));
            }
            return Ok(None);
        }
        self.chunks.push(info.clone());
        Ok(Some(info))
    }

    /// The payload as one array.
    pub fn array<T: Pod>(&mut self, info: &ChunkInfo) -> Result<Vec<T>, DecodeError> {
        let size = size_of::<T>() as u64;
        if !info.length.is_multiple_of(size) {
            return Err(info.bad(format!(
                "{} bytes are not a whole number of {size}",
                info.length
            )));
        }
        let mut hasher = crc32fast::Hasher::new();
        let context = || format!("inside chunk '{}' of {} bytes", info.name(), info.length);
        let offset = &mut self.offset;
        let data = array::read_growing(&mut self.input, info.length / size, |bytes, got| {
            *offset += got as u64;
            hasher.update(&bytes[..got]);
        })?;
        let Some(data) = data else {
            return Err(self.truncated(context()));
        };
        self.trailer(info, hasher.finalize())?;
        Ok(data)
    }

    /// Passes over an unknown chunk, verifying its checksum; refuses critical ones.
    pub fn skip(&mut self, info: &ChunkInfo) -> Result<(), DecodeError> {
        if !info.id[0].is_ascii_lowercase() {
            return Err(DecodeError::UnknownCritical {
                id: info.name(),
                offset: info.offset,
            });
        }
        if let Some(last) = self.chunks.last_mut() {
            last.known = false;
        }
        let mut hasher = crc32fast::Hasher::new();
        let mut buffer = vec![0; 1 << 16];
        let mut left = info.length;
        while left > 0 {
            let step = left.min(buffer.len() as u64) as usize;
            let context = || format!("inside chunk '{}' of {} bytes", info.name(), info.length);
            self.exact(&mut buffer[..step], context)?;
            hasher.update(&buffer[..step]);
            left -= step as u64;
        }
        self.trailer(info, hasher.finalize())
    }

    /// Verifies that nothing follows the end marker.
    pub fn finish(mut self) -> Result<Vec<ChunkInfo>, DecodeError> {
        let offset = self.offset;
        match self.fill(&mut [0])? {
            0 => Ok(self.chunks),
            _ => Err(DecodeError::TrailingBytes { offset }),
        }
    }

    fn trailer(&mut self, info: &ChunkInfo, computed: u32) -> Result<(), DecodeError> {
        let pad = padding(info.length);
        let mut tail = [0; 7 + TRAILER];
        let tail = &mut tail[..pad + TRAILER];
        self.exact(tail, || {
            format!("at the checksum of chunk '{}'", info.name())
        })?;
        let stored = LE::read_u32(&tail[pad..]);
        if stored != computed {
            let what = format!("chunk '{}'", info.name());
            return Err(DecodeError::Checksum {
                what,
                offset: info.offset,
                stored,
                computed,
            });
        }
        if tail[..pad].iter().any(|&b| b != 0) {
            return Err(info.bad("the padding after its payload is not zero"));
        }
        if tail[pad + 4..] != [0; 4] {
            return Err(info.bad("the four bytes after its checksum are not zero"));
        }
        Ok(())
    }

    fn exact(
        &mut self,
        buffer: &mut [u8],
        context: impl Fn() -> String,
    ) -> Result<(), DecodeError> {
        if self.fill(buffer)? < buffer.len() {
            return Err(self.truncated(context()));
        }
        Ok(())
    }

    fn fill(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let got = array::fill(&mut self.input, buffer)?;
        self.offset += got as u64;
        Ok(got)
    }

    fn truncated(&self, context: impl Into<String>) -> DecodeError {
        DecodeError::Truncated {
            offset: self.offset,
            context: context.into(),
        }
    }
}
