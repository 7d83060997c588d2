//! Data arrays of VTK XML files: text, base64 or raw, whole or in compressed blocks.
//!
//! Layout after the VTK file format description: a header of 32- or 64-bit counts, then the data. Without
//! compression the header is the number of bytes. With it: number of blocks, size of a block, size of the last
//! one (0: it is full), then the compressed size of each, then the blocks.

use std::io::Read;

use base64::{Engine, engine::general_purpose::STANDARD};
use flate2::read::ZlibDecoder;

/// Most bytes one byte of LZ4 can stand for: a forged size beyond it must not be allocated.
const LZ4_MAX_RATIO: u64 = 255;

/// How the file stores binary arrays.
#[derive(Debug, Clone, Copy)]
pub(super) struct Encoding {
    /// Most significant byte first.
    pub(super) big_endian: bool,
    /// Bytes of a count in a header: 4 or 8.
    pub(super) header_bytes: usize,
    /// Compression of the blocks.
    pub(super) compression: Compression,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Compression {
    None,
    Zlib,
    Lz4,
}

/// Type of the numbers of an array.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scalar {
    Signed(usize),
    Unsigned(usize),
    Float(usize),
}

impl Scalar {
    /// The type by its VTK name, such as "Float32".
    pub(super) fn named(name: &str) -> Result<Scalar, String> {
        Ok(match name {
            "Int8" => Scalar::Signed(1),
            "Int16" => Scalar::Signed(2),
            "Int32" => Scalar::Signed(4),
            "Int64" => Scalar::Signed(8),
            "UInt8" => Scalar::Unsigned(1),
            "UInt16" => Scalar::Unsigned(2),
            "UInt32" => Scalar::Unsigned(4),
            "UInt64" => Scalar::Unsigned(8),
            "Float32" => Scalar::Float(4),
            "Float64" => Scalar::Float(8),
            other => return Err(format!("unknown type \"{other}\"")),
        })
    }

    fn bytes(self) -> usize {
        match self {
            Scalar::Signed(n) | Scalar::Unsigned(n) | Scalar::Float(n) => n,
        }
    }
}

/// Numbers of an array; those of integer types stay exact.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Numbers {
    Integers(Vec<i64>),
    Floats(Vec<f64>),
}

impl Numbers {
    /// All numbers as floating point.
    pub(super) fn floats(self) -> Vec<f64> {
        match self {
            Numbers::Floats(values) => values,
            Numbers::Integers(values) => values.into_iter().map(|i| i as f64).collect(),
        }
    }

    /// All numbers as indices; an error for one that is negative or not an integer.
    pub(super) fn indices(self) -> Result<Vec<usize>, String> {
        match self {
            Numbers::Integers(values) => values
                .into_iter()
                .map(|i| usize::try_from(i).map_err(|_| format!("{i} is no index")))
                .collect(),
            Numbers::Floats(_) => Err("holds floating-point numbers where indices belong".to_owned()),
        }
    }
}

/// Reads numbers written as text.
pub(super) fn from_text(text: &str, scalar: Scalar) -> Result<Numbers, String> {
    fn parse<T: std::str::FromStr>(text: &str) -> Result<Vec<T>, String> {
        let number = |w: &str| {
            w.parse().map_err(|_| format!("\"{}\" is no number", w.chars().take(40).collect::<String>()))
        };
        text.split_ascii_whitespace().map(number).collect()
    }
    match scalar {
        Scalar::Float(_) => parse(text).map(Numbers::Floats),
        _ => parse(text).map(Numbers::Integers),
    }
}

/// Decodes base64 in which parts with a padding of their own follow each other, as VTK writes header and data.
///
/// Ends at the first character that is neither base64 nor white space, such as the `<` of the next tag.
pub(super) fn from_base64(text: &[u8]) -> Result<Vec<u8>, String> {
    let is_code = |b: &u8| b.is_ascii_alphanumeric() || b"+/=".contains(b);
    let code: Vec<u8> =
        text.iter().copied().filter(|b| !b.is_ascii_whitespace()).take_while(is_code).collect();
    let mut bytes = Vec::with_capacity(code.len() / 4 * 3);
    let mut rest = &code[..];
    while !rest.is_empty() {
        let padding = rest.iter().position(|&b| b == b'=').unwrap_or(rest.len());
        // Groups of four; an incomplete one at the end is the mark of a truncated file.
        let end = ((padding / 4 + usize::from(padding < rest.len())) * 4).min(rest.len());
        if end == 0 {
            break;
        }
        let (part, after) = rest.split_at(end);
        STANDARD.decode_vec(part, &mut bytes).map_err(|e| format!("damaged base64: {e}"))?;
        rest = after;
    }
    Ok(bytes)
}

/// Reads numbers from a header and its data. `bytes` may go on beyond them.
pub(super) fn from_bytes(bytes: &[u8], encoding: Encoding, scalar: Scalar) -> Result<Numbers, String> {
    let data = unpack(bytes, encoding)?;
    let size = scalar.bytes();
    if data.len() % size != 0 {
        return Err(format!("its {} bytes are no whole number of values of {size} bytes", data.len()));
    }
    let bits = data.chunks_exact(size).map(|chunk| {
        let mut word = [0; 8];
        word[..size].copy_from_slice(chunk);
        if encoding.big_endian {
            word[..size].reverse();
        }
        u64::from_le_bytes(word)
    });
    Ok(match scalar {
        Scalar::Float(4) => Numbers::Floats(bits.map(|b| f64::from(f32::from_bits(b as u32))).collect()),
        Scalar::Float(_) => Numbers::Floats(bits.map(f64::from_bits).collect()),
        // Above 2^63 the index becomes negative, and is refused as any other that is out of range.
        Scalar::Unsigned(_) => Numbers::Integers(bits.map(|b| b as i64).collect()),
        Scalar::Signed(_) => {
            let unused = 64 - 8 * size as u32;
            Numbers::Integers(bits.map(|b| ((b << unused) as i64) >> unused).collect())
        }
    })
}

/// Counts and data, taken from the front of bytes that may end too early.
struct Reader<'a> {
    rest: &'a [u8],
    encoding: Encoding,
}

impl<'a> Reader<'a> {
    fn take(&mut self, count: u64) -> Result<&'a [u8], String> {
        let available = self.rest.len();
        let split = usize::try_from(count).ok().and_then(|n| self.rest.split_at_checked(n));
        let (taken, rest) = split.ok_or_else(|| {
            format!("{count} bytes announced, {available} left: the file is cut off or damaged")
        })?;
        self.rest = rest;
        Ok(taken)
    }

    fn count(&mut self) -> Result<u64, String> {
        let field = self.take(self.encoding.header_bytes as u64)?;
        let join = |value: u64, byte: &u8| value << 8 | u64::from(*byte);
        Ok(if self.encoding.big_endian {
            field.iter().fold(0, join)
        } else {
            field.iter().rev().fold(0, join)
        })
    }
}

fn unpack(bytes: &[u8], encoding: Encoding) -> Result<Vec<u8>, String> {
    let mut reader = Reader { rest: bytes, encoding };
    let first = reader.count()?;
    if encoding.compression == Compression::None {
        return Ok(reader.take(first)?.to_vec());
    }
    let (block_size, last_size) = (reader.count()?, reader.count()?);
    // Taken one by one: a forged number of blocks ends with the file.
    let mut sizes = Vec::new();
    for _ in 0..first {
        sizes.push(reader.count()?);
    }
    let mut data = Vec::new();
    for (i, &size) in sizes.iter().enumerate() {
        let packed = reader.take(size)?;
        let is_partial = i + 1 == sizes.len() && last_size > 0;
        let expected = if is_partial { last_size } else { block_size };
        let before = data.len();
        match encoding.compression {
            Compression::None => data.extend_from_slice(packed),
            Compression::Zlib => {
                let damaged = |e| format!("block {i} is damaged: {e}");
                ZlibDecoder::new(packed).take(expected).read_to_end(&mut data).map_err(damaged)?;
            }
            Compression::Lz4 => {
                if expected > LZ4_MAX_RATIO * (size + 1) {
                    return Err(format!("block {i} of {size} bytes cannot unpack to {expected}"));
                }
                let unpacked = lz4_flex::block::decompress(packed, expected as usize);
                data.extend(unpacked.map_err(|e| format!("block {i} is damaged: {e}"))?);
            }
        }
        let found = (data.len() - before) as u64;
        if found != expected {
            return Err(format!("block {i} unpacks to {found} bytes, not {expected}"));
        }
    }
    Ok(data)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAIN: Encoding = Encoding { big_endian: false, header_bytes: 4, compression: Compression::None };

    #[test]
    fn integers_keep_sign_and_order() {
        let bytes = [4, 0, 0, 0, 0xfe, 0xff, 2, 1];
        assert_eq!(from_bytes(&bytes, PLAIN, Scalar::Signed(2)), Ok(Numbers::Integers(vec![-2, 258])));
        assert_eq!(from_bytes(&bytes, PLAIN, Scalar::Unsigned(2)), Ok(Numbers::Integers(vec![65534, 258])));
        let big = Encoding { big_endian: true, header_bytes: 8, ..PLAIN };
        let bytes = [0, 0, 0, 0, 0, 0, 0, 2, 1, 2];
        assert_eq!(from_bytes(&bytes, big, Scalar::Signed(2)), Ok(Numbers::Integers(vec![258])));
    }

    #[test]
    fn padded_parts_of_base64_join() {
        // "TQ==" and "YW4=" are "M" and "an".
        assert_eq!(from_base64(b" TQ==\nYW4=  </DataArray>"), Ok(b"Man".to_vec()));
        assert_eq!(from_base64(b"TWFu"), Ok(b"Man".to_vec()));
        assert_eq!(from_base64(b"TWFuT"), Ok(b"Man".to_vec()));
        assert!(from_base64(b"T===").is_err());
    }

    #[test]
    fn forged_counts_are_refused_without_allocating() {
        for compression in [Compression::None, Compression::Zlib, Compression::Lz4] {
            let encoding = Encoding { compression, header_bytes: 8, ..PLAIN };
            assert!(from_bytes(&[0xff; 40], encoding, Scalar::Float(8)).is_err());
        }
        let lz4 = Encoding { compression: Compression::Lz4, ..PLAIN };
        // One block that claims to unpack to 4 GB.
        let bytes = [1, 0, 0, 0, 255, 255, 255, 255, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0];
        assert!(from_bytes(&bytes, lz4, Scalar::Float(8)).unwrap_err().contains("cannot unpack"));
    }
}
