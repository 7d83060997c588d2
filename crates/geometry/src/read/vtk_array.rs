//! Data arrays of VTK XML files: from text or bytes to numbers.

use super::vtk_blocks::{Encoding, Source, unpack};

/// Bytes of decoded numbers that a file may hold for each of its own. A pipe of regular rings in 64-bit numbers, which
/// zlib packs better than any vessel, has 6.
const MAX_EXPANSION: u64 = 16;
/// Bytes of decoded numbers that any file may hold.
const FREE_EXPANSION: u64 = 1 << 20;
/// Bytes of a number in memory.
const NUMBER: u64 = 8;

/// The memory that the arrays of a file may still take.
///
/// Compression can make a thousand bytes out of one, and many arrays can point to the same place of a file.
#[derive(Debug)]
pub(super) struct Budget {
    file_size: u64,
    left: u64,
}

impl Budget {
    /// For a file of so many bytes.
    pub(super) fn new(file_size: usize) -> Budget {
        let file_size = file_size as u64;
        Budget { file_size, left: file_size.saturating_mul(MAX_EXPANSION).saturating_add(FREE_EXPANSION) }
    }

    /// Takes the memory of so many numbers off it.
    fn spend(&mut self, count: u64) -> Result<(), String> {
        let bytes = count.saturating_mul(NUMBER);
        self.left = self.left.checked_sub(bytes).ok_or_else(|| {
            format!(
                "its {count} values bring the arrays to more than {MAX_EXPANSION} times the {} bytes of the file; \
                 if that is meant, save it again without compression",
                self.file_size
            )
        })?;
        Ok(())
    }
}

/// How many numbers an array must hold, and what says so.
#[derive(Debug, Clone)]
pub(super) struct Expected {
    /// The number of values.
    pub(super) count: u64,
    /// The attribute or array that asks for them.
    pub(super) by: String,
}

/// Holds the length of an array against what is expected of it.
fn check_count(found: u64, expected: Option<&Expected>) -> Result<(), String> {
    match expected {
        Some(Expected { count, by }) if found != *count => {
            Err(format!("holds {found} values, but {by} asks for {count}"))
        }
        _ => Ok(()),
    }
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
pub(super) fn from_text(
    text: &str,
    scalar: Scalar,
    expected: Option<&Expected>,
    budget: &mut Budget,
) -> Result<Numbers, String> {
    fn parse<T: std::str::FromStr>(text: &str, count: usize) -> Result<Vec<T>, String> {
        let mut numbers = Vec::with_capacity(count);
        for word in text.split_ascii_whitespace() {
            let start = || word.chars().take(40).collect::<String>();
            numbers.push(word.parse().map_err(|_| format!("\"{}\" is no number", start()))?);
        }
        Ok(numbers)
    }
    let count = text.split_ascii_whitespace().count();
    check_count(count as u64, expected)?;
    budget.spend(count as u64)?;
    match scalar {
        Scalar::Float(_) => parse(text, count).map(Numbers::Floats),
        _ => parse(text, count).map(Numbers::Integers),
    }
}

/// Reads numbers from bytes that begin with a header.
pub(super) fn from_bytes(
    source: &mut Source,
    encoding: Encoding,
    scalar: Scalar,
    expected: Option<&Expected>,
    budget: &mut Budget,
) -> Result<Numbers, String> {
    let size = scalar.bytes();
    let data = unpack(source, encoding, |length| {
        if length % size as u64 != 0 {
            return Err(format!("its {length} bytes are no whole number of values of {size} bytes"));
        }
        check_count(length / size as u64, expected)?;
        budget.spend(length / size as u64)
    })?;
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

#[cfg(test)]
mod tests {
    use super::super::vtk_blocks::Compression;
    use super::*;

    const PLAIN: Encoding = Encoding { big_endian: false, header_bytes: 4, compression: Compression::None };

    fn read(bytes: &[u8], encoding: Encoding, scalar: Scalar) -> Result<Numbers, String> {
        from_bytes(&mut Source::Raw(bytes), encoding, scalar, None, &mut Budget::new(bytes.len()))
    }

    #[test]
    fn integers_keep_sign_and_order() {
        let bytes = [4, 0, 0, 0, 0xfe, 0xff, 2, 1];
        assert_eq!(read(&bytes, PLAIN, Scalar::Signed(2)), Ok(Numbers::Integers(vec![-2, 258])));
        assert_eq!(read(&bytes, PLAIN, Scalar::Unsigned(2)), Ok(Numbers::Integers(vec![65534, 258])));
        let big = Encoding { big_endian: true, header_bytes: 8, ..PLAIN };
        let bytes = [0, 0, 0, 0, 0, 0, 0, 2, 1, 2];
        assert_eq!(read(&bytes, big, Scalar::Signed(2)), Ok(Numbers::Integers(vec![258])));
    }

    #[test]
    fn a_count_that_does_not_fit_says_what_asked_for_it() {
        let expected = Expected { count: 3, by: "NumberOfPolys".to_owned() };
        let outcome = from_text("1 2", Scalar::Signed(4), Some(&expected), &mut Budget::new(3));
        assert_eq!(outcome, Err("holds 2 values, but NumberOfPolys asks for 3".to_owned()));
    }

    #[test]
    fn the_budget_is_for_all_arrays_together() {
        let mut budget = Budget::new(0);
        assert_eq!(budget.spend(FREE_EXPANSION / NUMBER), Ok(()));
        assert!(budget.spend(1).is_err_and(|e| e.contains("more than 16 times the 0 bytes")));
        assert!(Budget::new(usize::MAX).spend(u64::MAX).is_ok());
    }
}
