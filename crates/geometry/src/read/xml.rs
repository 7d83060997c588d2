//! The XML of VTK files, held to a size before it is read.
//!
//! Time and memory of `roxmltree` grow with the square of the attributes of an element and faster with nested
//! namespaces. Files of VTK have some dozen elements of some dozen attributes and no namespaces, so limits far above
//! them refuse nothing but forgeries. It refuses document types by itself, and entities with them.

use roxmltree::{Document, ParsingOptions};

/// Most elements, texts and comments.
const MAX_NODES: u32 = 1 << 16;
/// Most equals signs, for each of which `roxmltree` keeps room for an attribute.
const MAX_EQUALS_SIGNS: usize = 1 << 16;
/// Most bytes of a tag with its attributes.
const MAX_TAG: usize = 4096;
/// Most tags that declare a namespace.
const MAX_NAMESPACES: usize = 8;

/// Reads the XML of a file whose data may be inside, as text.
pub(super) fn parse(text: &str) -> Result<Document<'_>, String> {
    check_tags(text)?;
    let options = ParsingOptions { nodes_limit: MAX_NODES, ..ParsingOptions::default() };
    Document::parse_with_options(text, options).map_err(|e| format!("damaged XML: {e}"))
}

fn check_tags(text: &str) -> Result<(), String> {
    let mut rest = text;
    let (mut n_tags, mut n_namespaces) = (0, 0);
    while let Some(start) = rest.find('<') {
        rest = &rest[start..];
        n_tags += 1;
        if n_tags > MAX_NODES {
            return Err(format!("more than {MAX_NODES} tags"));
        }
        let is_free =
            [("<!--", "-->"), ("<![CDATA[", "]]>")].into_iter().find(|(from, _)| rest.starts_with(from));
        let length = match is_free {
            Some((_, to)) => rest.find(to).map(|at| at + to.len()),
            None => {
                let length = tag_length(rest.as_bytes());
                let tag = &rest.as_bytes()[..length.unwrap_or(MAX_TAG).min(rest.len())];
                n_namespaces += usize::from(tag.windows(5).any(|word| word == b"xmlns"));
                if length.is_none() && rest.len() > MAX_TAG {
                    let at = text.len() - rest.len();
                    return Err(format!("the tag at byte {at} is longer than {MAX_TAG} bytes"));
                }
                length
            }
        };
        if n_namespaces > MAX_NAMESPACES {
            return Err(format!(
                "more than {MAX_NAMESPACES} of its tags declare a namespace; VTK declares none"
            ));
        }
        // What never ends is left to the parser, which says what is missing.
        let Some(length) = length else { break };
        rest = &rest[length..];
    }
    if text.bytes().filter(|&byte| byte == b'=').count() > MAX_EQUALS_SIGNS {
        return Err(format!("more than {MAX_EQUALS_SIGNS} equals signs: too many attributes"));
    }
    Ok(())
}

/// Bytes of the tag at the start, with its brackets; `None` when it does not end within [`MAX_TAG`].
fn tag_length(bytes: &[u8]) -> Option<usize> {
    let mut quote = None;
    for (at, &byte) in bytes.iter().enumerate().take(MAX_TAG) {
        match quote {
            Some(open) if byte == open => quote = None,
            Some(_) => {}
            None if byte == b'>' => return Some(at + 1),
            None if byte == b'"' || byte == b'\'' => quote = Some(byte),
            None => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ordinary_files_pass() {
        let long_comment = format!("<!-- {} -->", "no tag > here ".repeat(1000));
        let text = format!("<?xml version=\"1.0\"?>{long_comment}<a b='>'>{}<c/></a>", "1 ".repeat(9000));
        assert!(parse(&text).is_ok_and(|document| document.root_element().has_tag_name("a")));
    }

    #[test]
    fn oversize_is_refused_by_name() {
        let attributes: String = (0..20_000).map(|i| format!(" a{i}=''")).collect();
        let hidden = format!("<a z='>'{attributes}/>");
        let error = parse(&hidden).expect_err("too long");
        assert_eq!(error, "the tag at byte 0 is longer than 4096 bytes");
        let nested: String = (0..9).map(|i| format!("<a xmlns:n{i}='{i}'>")).collect();
        assert!(parse(&nested).expect_err("too many").contains("declare a namespace"));
        assert!(parse(&"<a>".repeat(100_000)).expect_err("too deep").contains("more than 65536 tags"));
        let entities = "<!DOCTYPE a [<!ENTITY b \"bbbbbbbb\"><!ENTITY c \"&b;&b;&b;\">]><a>&c;</a>";
        assert!(parse(entities).expect_err("entities").contains("DTD"));
        assert!(parse("<a b=\"").is_err());
    }
}
