//! Writing PNG files.

use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::io::Write;

/// A PNG file of eight bits per channel; `pixels` are red, green and blue, row by row from the top.
pub fn encode(width: u32, height: u32, pixels: &[u8]) -> Vec<u8> {
    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut header = [width.to_be_bytes(), height.to_be_bytes()].concat();
    // Eight bits, three channels, and the only compression, filtering and order there is.
    header.extend([8, 2, 0, 0, 0]);
    chunk(&mut file, b"IHDR", &header);
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::new(6));
    let row = 3 * width as usize;
    let written = pixels.chunks_exact(row).try_for_each(|line| {
        // Each row is stored as differences from the pixel before.
        encoder.write_all(&[1])?;
        let shifted = [0; 3].iter().chain(line);
        let differences: Vec<u8> = line
            .iter()
            .zip(shifted)
            .map(|(&a, &b)| a.wrapping_sub(b))
            .collect();
        encoder.write_all(&differences)
    });
    let data = written.and_then(|()| encoder.finish()).unwrap_or_default();
    chunk(&mut file, b"IDAT", &data);
    chunk(&mut file, b"IEND", &[]);
    file
}

fn chunk(file: &mut Vec<u8>, kind: &[u8; 4], data: &[u8]) {
    file.extend((data.len() as u32).to_be_bytes());
    let begin = file.len();
    file.extend(kind);
    file.extend(data);
    let sum = crc32fast::hash(&file[begin..]);
    file.extend(sum.to_be_bytes());
}

/// Bytes as base64 text.
pub fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let mut word = 0_u32;
        for i in 0..3 {
            word = word << 8 | u32::from(group.get(i).copied().unwrap_or(0));
        }
        for i in 0..4 {
            if i <= group.len() {
                let digit = word >> (18 - 6 * i) & 63;
                text.push(char::from(DIGITS[digit as usize]));
            } else {
                text.push('=');
            }
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_texts_in_base64() {
        for (bytes, text) in [("", ""), ("M", "TQ=="), ("Ma", "TWE="), ("Man", "TWFu")] {
            assert_eq!(base64(bytes.as_bytes()), text);
        }
    }

    #[test]
    fn chunks_carry_their_sums() {
        let file = encode(2, 1, &[1, 2, 3, 4, 5, 6]);
        assert!(
            file.starts_with(b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x02\0\0\0\x01\x08\x02\0\0\0")
        );
        // The end of every such file.
        assert!(file.ends_with(b"\0\0\0\0IEND\xae\x42\x60\x82"));
    }
}
