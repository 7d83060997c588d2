//! Bytes of the data arrays of VTK XML files: base64 or raw, whole or in compressed blocks.
//!
//! Layout after the VTK file format description: a header of 32- or 64-bit counts, then the data. Without
//! compression the header is the number of bytes. With it: number of blocks, size of a block, size of the last
//! one (0: it is full), then the compressed size of each, then the blocks.
//!
//! A header is held against the bytes that follow it before memory is taken for what it announces.

use std::{borrow::Cow, io::Read};

use base64::{Engine, engine::general_purpose::STANDARD};
use flate2::read::ZlibDecoder;

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

impl Compression {
    /// Most bytes one byte can stand for: 258 in 2 bits for zlib (RFC 1951), runs of 255 for lz4.
    fn max_ratio(self) -> u64 {
        match self {
            Compression::None => 1,
            Compression::Zlib => 1032,
            Compression::Lz4 => 255,
        }
    }
}

/// The bytes of an array from its header on; they may go on beyond its end.
pub(super) enum Source<'a> {
    /// As they are.
    Raw(&'a [u8]),
    /// As base64, up to the first character that is neither that nor white space, such as the `<` of a tag.
    Base64 {
        /// What is left of the text.
        text: &'a [u8],
        /// Bytes decoded that were not asked for: a group of four characters is three of them.
        decoded: Vec<u8>,
    },
}

impl<'a> Source<'a> {
    pub(super) fn base64(text: &'a [u8]) -> Source<'a> {
        Source::Base64 { text, decoded: Vec::new() }
    }

    /// Whether nothing is left.
    pub(super) fn is_empty(&self) -> bool {
        match self {
            Source::Raw(bytes) => bytes.is_empty(),
            Source::Base64 { text, decoded } => decoded.is_empty() && code(text).next().is_none(),
        }
    }

    /// Bytes left, up to the padding of base64.
    fn left(&self) -> u64 {
        match self {
            Source::Raw(bytes) => bytes.len() as u64,
            Source::Base64 { text, decoded } => (decoded.len() + code(text).count() / 4 * 3) as u64,
        }
    }

    /// An error where so many bytes cannot be left.
    fn check(&self, count: u64) -> Result<(), String> {
        let most = match self {
            Source::Raw(bytes) => bytes.len(),
            Source::Base64 { text, decoded } => decoded.len() + text.len(),
        };
        if count > most as u64 { Err(cut(count, self.left())) } else { Ok(()) }
    }

    /// Takes bytes from the front.
    fn take(&mut self, count: u64) -> Result<Cow<'a, [u8]>, String> {
        self.check(count)?;
        let count = count as usize;
        match self {
            Source::Raw(bytes) => {
                let (taken, rest) = bytes.split_at(count);
                *bytes = rest;
                Ok(Cow::Borrowed(taken))
            }
            Source::Base64 { text, decoded } => {
                let mut bytes = std::mem::take(decoded);
                bytes.reserve_exact(count.saturating_sub(bytes.len()).next_multiple_of(3));
                while bytes.len() < count {
                    let part = next_part(text, (count - bytes.len()).div_ceil(3) * 4);
                    if part.is_empty() {
                        return Err(cut(count as u64, bytes.len() as u64));
                    }
                    STANDARD.decode_vec(part, &mut bytes).map_err(|e| format!("damaged base64: {e}"))?;
                }
                *decoded = bytes.split_off(count);
                Ok(Cow::Owned(bytes))
            }
        }
    }

    fn count(&mut self, encoding: Encoding) -> Result<u64, String> {
        Ok(count(&self.take(encoding.header_bytes as u64)?, encoding))
    }
}

fn cut(announced: u64, left: u64) -> String {
    format!("{announced} bytes announced, {left} left: the file is cut off or damaged")
}

fn count(field: &[u8], encoding: Encoding) -> u64 {
    let join = |value: u64, byte: &u8| value << 8 | u64::from(*byte);
    if encoding.big_endian { field.iter().fold(0, join) } else { field.iter().rev().fold(0, join) }
}

fn is_code(byte: &u8) -> bool {
    byte.is_ascii_alphanumeric() || b"+/=".contains(byte)
}

/// The characters of base64, white space left out.
fn code(text: &[u8]) -> impl Iterator<Item = u8> {
    text.iter().copied().filter(|b| !b.is_ascii_whitespace()).take_while(is_code)
}

/// Takes whole groups of four characters off a text, at most so many characters, and none behind a padded group: VTK
/// writes header and data one after the other, each with a padding of its own.
fn next_part(text: &mut &[u8], most: usize) -> Vec<u8> {
    let mut part = Vec::with_capacity(most.min(text.len()));
    let mut end = 0;
    for (at, &byte) in text.iter().enumerate() {
        if byte.is_ascii_whitespace() {
            continue;
        }
        if !is_code(&byte) {
            break;
        }
        part.push(byte);
        if part.len() % 4 == 0 {
            end = at + 1;
            if byte == b'=' || part.len() >= most {
                break;
            }
        }
    }
    // An incomplete group at the end is the mark of a truncated file.
    part.truncate(part.len() / 4 * 4);
    *text = &text[end..];
    part
}

/// The data of an array, unpacked. `accept` is told their length beforehand and may refuse it.
pub(super) fn unpack<'a>(
    source: &mut Source<'a>,
    encoding: Encoding,
    accept: impl FnOnce(u64) -> Result<(), String>,
) -> Result<Cow<'a, [u8]>, String> {
    let first = source.count(encoding)?;
    if encoding.compression == Compression::None {
        source.check(first)?;
        accept(first)?;
        return source.take(first);
    }
    let (block_size, last_size) = (source.count(encoding)?, source.count(encoding)?);
    let table_size = first.saturating_mul(encoding.header_bytes as u64);
    let table = source.take(table_size).map_err(|e| format!("a header of {first} compressed blocks: {e}"))?;
    let blocks: Vec<Block> = table
        .chunks_exact(encoding.header_bytes)
        .enumerate()
        .map(|(i, field)| {
            let is_partial = i as u64 + 1 == first && last_size > 0;
            Block {
                packed: count(field, encoding),
                unpacked: if is_partial { last_size } else { block_size },
            }
        })
        .collect();
    let mut total: u64 = 0;
    for (i, block) in blocks.iter().enumerate() {
        let Block { packed, unpacked } = *block;
        // One more than the bytes there are, for the fixed bytes of a format.
        if unpacked > packed.saturating_add(1).saturating_mul(encoding.compression.max_ratio()) {
            return Err(format!("block {i} of {packed} bytes cannot unpack to {unpacked}"));
        }
        total = total.saturating_add(unpacked);
    }
    accept(total)?;
    let mut data = Vec::new();
    for (i, block) in blocks.iter().enumerate() {
        block
            .append(&source.take(block.packed)?, encoding.compression, &mut data)
            .map_err(|e| format!("block {i} {e}"))?;
    }
    Ok(Cow::Owned(data))
}

/// Sizes of a compressed block \[bytes\].
struct Block {
    packed: u64,
    unpacked: u64,
}

impl Block {
    fn append(&self, packed: &[u8], compression: Compression, data: &mut Vec<u8>) -> Result<(), String> {
        let before = data.len();
        match compression {
            Compression::None => data.extend_from_slice(packed),
            Compression::Zlib => {
                // One byte more tells a block that is too long from one that fits.
                let mut unpacked = ZlibDecoder::new(packed).take(self.unpacked + 1);
                unpacked.read_to_end(data).map_err(|e| format!("is damaged: {e}"))?;
            }
            Compression::Lz4 => {
                let unpacked = lz4_flex::block::decompress(packed, self.unpacked as usize);
                data.extend(unpacked.map_err(|e| format!("is damaged: {e}"))?);
            }
        }
        match (data.len() - before) as u64 {
            found if found == self.unpacked => Ok(()),
            found if found > self.unpacked => Err(format!("unpacks to more than {} bytes", self.unpacked)),
            found => Err(format!("unpacks to {found} bytes, not {}", self.unpacked)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAIN: Encoding = Encoding { big_endian: false, header_bytes: 4, compression: Compression::None };

    fn all(text: &[u8], count: u64) -> Result<Vec<u8>, String> {
        Source::base64(text).take(count).map(Cow::into_owned)
    }

    #[test]
    fn padded_parts_of_base64_join() {
        // "TQ==" and "YW4=" are "M" and "an".
        assert_eq!(all(b" TQ==\nYW4=  </DataArray>", 3), Ok(b"Man".to_vec()));
        assert_eq!(all(b"TWFu", 3), Ok(b"Man".to_vec()));
        assert!(all(b"TWFuT", 4).is_err_and(|e| e.contains("4 bytes announced, 3 left")));
        assert!(all(b"T===", 1).is_err_and(|e| e.contains("damaged base64")));
    }

    #[test]
    fn bytes_of_a_group_may_be_taken_apart() {
        let mut source = Source::base64(b"TWFuTWFu");
        for (count, expected) in [(1, &b"M"[..]), (3, b"anM"), (0, b""), (2, b"an")] {
            assert_eq!(source.take(count).as_deref(), Ok(expected));
        }
        assert!(source.is_empty() && source.take(1).is_err());
    }

    #[test]
    fn forged_counts_are_refused_before_the_data() {
        for compression in [Compression::None, Compression::Zlib, Compression::Lz4] {
            let encoding = Encoding { compression, header_bytes: 8, ..PLAIN };
            let mut source = Source::Raw(&[0xff; 40]);
            assert!(unpack(&mut source, encoding, |_| Ok(())).is_err_and(|e| e.contains("announced")));
        }
        let compressed = |compression| Encoding { compression, ..PLAIN };
        // One block of two bytes that claims to unpack to 4 GB.
        let bytes = [1, 0, 0, 0, 255, 255, 255, 255, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0];
        for compression in [Compression::Zlib, Compression::Lz4] {
            let outcome = unpack(&mut Source::Raw(&bytes), compressed(compression), |_| unreachable!());
            assert_eq!(outcome, Err("block 0 of 2 bytes cannot unpack to 4294967295".to_owned()));
        }
    }

    #[test]
    fn a_block_must_hold_what_its_header_says() {
        let packed = lz4_flex::block::compress(&[7; 12]);
        let file = |size: u8| {
            let header = [1, 0, 0, 0, size, 0, 0, 0, 0, 0, 0, 0, packed.len() as u8, 0, 0, 0];
            [&header[..], &packed].concat()
        };
        let encoding = Encoding { compression: Compression::Lz4, ..PLAIN };
        assert_eq!(unpack(&mut Source::Raw(&file(12)), encoding, |_| Ok(())).as_deref(), Ok(&[7; 12][..]));
        for size in [11, 13] {
            let bytes = file(size);
            let outcome = unpack(&mut Source::Raw(&bytes), encoding, |_| Ok(()));
            assert!(outcome.is_err_and(|e| e.starts_with("block 0")));
        }
    }
}
