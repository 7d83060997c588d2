//! From text to a quantity in SI units.

use std::fmt;
use std::ops::Range;

use crate::dimension::{Dimension, NUMBER};
use crate::error::UnitError;
use crate::table::{look_up, nearest_symbol};

/// A number with its dimension.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantity {
    /// The value in the SI unit of the dimension.
    pub value: f64,
    /// What kind of quantity it is.
    pub dimension: Dimension,
}

/// The value in SI base units with all its digits, so that reading it gives the same bits.
impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.value)?;
        if self.dimension == NUMBER { Ok(()) } else { write!(f, " {}", self.dimension) }
    }
}

/// Reads a quantity such as `"80 mmHg"`, `"3.5 mPa s"` or `"1.5e8 Pa s/m^3"`.
///
/// The number comes first, then the unit: symbols joined by a space, `*` or `·`, each with an exponent (`m^3`, `m3`,
/// `m³`, `s^-1`), and `/` before what divides. Several factors below the line need parentheses, `1/(Pa s)`.
///
/// # Errors
/// [`UnitError`] when there is no number or the unit cannot be read.
pub fn parse(text: &str) -> Result<Quantity, UnitError> {
    let (number, unit_start) = split_number(text)?;
    let unit = Parser::read(text, unit_start)?;
    // Shifting the decimal exponent in the text rounds once; multiplying by 1e-3 would round twice.
    let (mantissa, exponent) = match number.find(['e', 'E']) {
        Some(at) => (&number[..at], number[at + 1..].parse::<i32>().unwrap_or(i32::MAX)),
        None => (number, 0),
    };
    let shifted = format!("{mantissa}e{}", exponent.saturating_add(unit.decade));
    let value = shifted.parse::<f64>().map_or(f64::INFINITY, |value| value * unit.factor);
    if !value.is_finite() {
        let start = text.len() - text.trim_start().len();
        return Err(UnitError::TooLarge { text: text.to_owned(), span: start..start + number.len() });
    }
    Ok(Quantity { value, dimension: unit.dimension })
}

/// Reads a quantity of a given dimension and returns its SI value.
///
/// # Errors
/// [`UnitError`] as [`parse`], and when the dimension is another one or the unit is missing.
pub fn parse_as(text: &str, expected: Dimension) -> Result<f64, UnitError> {
    let Quantity { value, dimension } = parse(text)?;
    if dimension == expected {
        return Ok(value);
    }
    let (_, unit_start) = split_number(text)?;
    let unit = text[unit_start..].trim();
    if unit.is_empty() {
        return Err(UnitError::MissingUnit { text: text.to_owned(), expected });
    }
    let start = unit_start + (text[unit_start..].len() - text[unit_start..].trim_start().len());
    let span = start..start + unit.len();
    Err(UnitError::WrongDimension { text: text.to_owned(), span, found: dimension, expected })
}

/// Reads a unit alone and returns how many SI units it is, and its dimension.
///
/// # Errors
/// [`UnitError`] when the unit cannot be read.
pub fn parse_unit(text: &str) -> Result<(f64, Dimension), UnitError> {
    let unit = Parser::read(text, 0)?;
    let decade = format!("1e{}", unit.decade).parse::<f64>().unwrap_or(f64::INFINITY);
    Ok((unit.factor * decade, unit.dimension))
}

/// The leading decimal number and the byte where the unit begins.
fn split_number(text: &str) -> Result<(&str, usize), UnitError> {
    let start = text.len() - text.trim_start().len();
    let bytes = text.as_bytes();
    let digits = |mut at: usize| {
        while bytes.get(at).is_some_and(u8::is_ascii_digit) {
            at += 1;
        }
        at
    };
    let signed = |at: usize| if matches!(bytes.get(at), Some(b'+' | b'-')) { at + 1 } else { at };
    let integer = signed(start);
    let mut end = digits(integer);
    let mut count = end - integer;
    if bytes.get(end) == Some(&b'.') {
        let fraction = digits(end + 1);
        count += fraction - end - 1;
        end = fraction;
    }
    if count == 0 {
        let fault = text[start..].find(char::is_whitespace).map_or(text.len(), |at| start + at);
        return Err(UnitError::Number { text: text.to_owned(), span: start..fault });
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let power = signed(end + 1);
        if digits(power) > power {
            end = digits(power);
        }
    }
    Ok((&text[start..end], end))
}

/// A unit as read: `factor * 10^decade` SI units.
#[derive(Clone, Copy)]
struct Product {
    factor: f64,
    decade: i32,
    dimension: Dimension,
}

impl Product {
    const ONE: Self = Self { factor: 1.0, decade: 0, dimension: NUMBER };

    fn times(self, other: Self, exponent: i8) -> Option<Self> {
        Some(Self {
            factor: self.factor * other.factor.powi(i32::from(exponent)),
            decade: self.decade + other.decade.checked_mul(i32::from(exponent))?,
            dimension: self.dimension.checked_mul(other.dimension.power(exponent)?)?,
        })
    }
}

/// Recursive descent over the unit part of `text`.
struct Parser<'a> {
    text: &'a str,
    at: usize,
    /// Inside parentheses, where a second pair is refused: no unit needs it, and depth must be bounded.
    nested: bool,
}

impl<'a> Parser<'a> {
    fn read(text: &'a str, start: usize) -> Result<Product, UnitError> {
        let mut parser = Self { text, at: start, nested: false };
        parser.skip_space();
        if parser.at == text.len() {
            return Ok(Product::ONE);
        }
        let product = parser.product()?;
        if parser.at < text.len() { Err(parser.syntax(parser.at..text.len())) } else { Ok(product) }
    }

    fn product(&mut self) -> Result<Product, UnitError> {
        let mut product = Product::ONE;
        let mut divide = false;
        let mut divided = false;
        loop {
            self.skip_space();
            let start = self.at;
            let factor = self.factor()?;
            if divided && !divide {
                let span = start..self.at;
                return Err(UnitError::Ambiguous { unit: self.text[span.clone()].to_owned(), span });
            }
            let sign = if divide { -1 } else { 1 };
            product = product.times(factor, sign).ok_or_else(|| self.syntax(start..self.at))?;
            divided |= divide;
            self.skip_space();
            match self.peek() {
                None | Some(')') => return Ok(product),
                Some('/') => {
                    divide = true;
                    self.at += 1;
                }
                Some(sign @ ('*' | '·')) => {
                    divide = false;
                    self.at += sign.len_utf8();
                }
                Some(_) => divide = false,
            }
        }
    }

    fn factor(&mut self) -> Result<Product, UnitError> {
        let start = self.at;
        if self.peek() == Some('(') && !self.nested {
            self.at += 1;
            self.nested = true;
            let inner = self.product()?;
            self.nested = false;
            if self.peek() != Some(')') {
                return Err(self.syntax(start..self.text.len()));
            }
            self.at += 1;
            return Ok(inner);
        }
        let rest = &self.text[start..];
        let length = rest.find(|c: char| c.is_whitespace() || "/*·()".contains(c)).unwrap_or(rest.len());
        let token = &rest[..length];
        self.at += length;
        if token == "1" {
            return Ok(Product::ONE);
        }
        if token.is_empty() {
            let end = self.peek().map_or(start, |c| start + c.len_utf8());
            return Err(self.syntax(start..end));
        }
        let (symbol, exponent) = self.split_exponent(token, start)?;
        let Some(unit) = look_up(symbol) else {
            let nearest = nearest_symbol(symbol);
            return Err(UnitError::UnknownUnit {
                unit: symbol.to_owned(),
                span: start..start + symbol.len(),
                nearest,
            });
        };
        let base = Product { factor: unit.factor, decade: unit.decade, dimension: unit.dimension };
        Product::ONE.times(base, exponent).ok_or_else(|| self.syntax(start..start + length))
    }

    /// Takes `m^3`, `m3`, `m³`, `s^-1` or `s-1` apart; `cmH2O` stays whole.
    fn split_exponent(&self, token: &'a str, start: usize) -> Result<(&'a str, i8), UnitError> {
        if look_up(token).is_some() {
            return Ok((token, 1));
        }
        if let Some(symbol) = token.strip_suffix('²') {
            return Ok((symbol, 2));
        }
        if let Some(symbol) = token.strip_suffix('³') {
            return Ok((symbol, 3));
        }
        let symbol = token.trim_end_matches(|c: char| c.is_ascii_digit()).trim_end_matches(['-', '+']);
        let exponent = &token[symbol.len()..];
        let (symbol, written) = (symbol.strip_suffix('^').unwrap_or(symbol), symbol.ends_with('^'));
        match exponent.parse::<i8>() {
            Ok(exponent) if !symbol.is_empty() => Ok((symbol, exponent)),
            _ if exponent.is_empty() && !written => Ok((token, 1)),
            _ => Err(self.syntax(start..start + token.len())),
        }
    }

    fn peek(&self) -> Option<char> {
        self.text[self.at..].chars().next()
    }

    fn skip_space(&mut self) {
        self.at = self.text.len() - self.text[self.at..].trim_start().len();
    }

    fn syntax(&self, span: Range<usize>) -> UnitError {
        UnitError::Syntax { unit: self.text[span.clone()].to_owned(), span }
    }
}
