//! Text into HTML, with nothing from the run's files ever taken for markup.

/// Text with the five characters that mean something in HTML made harmless.
pub(crate) fn escape(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            c => safe.push(c),
        }
    }
    safe
}

/// A sentence of the program as HTML: what stands between backticks is a name.
pub(crate) fn prose(text: &str) -> String {
    let parts: Vec<&str> = text.split('`').collect();
    // An odd number of backticks is no pair of quotes: leave them as they are.
    if parts.len().is_multiple_of(2) {
        return escape(text);
    }
    let mark = |(k, part): (usize, &&str)| match k % 2 {
        0 => escape(part),
        _ => format!("<code>{}</code>", escape(part)),
    };
    parts.iter().enumerate().map(mark).collect()
}

/// What a browser lets the page do: nothing comes from elsewhere, whatever the page says.
const POLICY: &str = include_str!("policy.txt");

/// A page of its own with style and nothing from elsewhere; `body` and `foot` are HTML already, and `style` is what a part of it
/// needs besides the style of all pages.
pub(crate) fn page(title: &str, style: &str, body: &str, foot: &str) -> String {
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<title>{} – vaso</title>\n<style>\n{}{style}</style>\n</head>\n\
         <body>\n<main>\n{body}</main>\n<footer><small>{foot}</small></footer>\n</body>\n</html>\n",
        escape(title),
        include_str!("style.css")
    )
}

/// A column of a table.
pub(crate) enum Column {
    /// Words, to the left.
    Words(&'static str),
    /// Numbers, to the right, with their unit.
    Numbers(&'static str, &'static str),
}

/// A table; cells are HTML already.
pub(crate) fn table(caption: &str, columns: &[Column], rows: &[Vec<String>]) -> String {
    let class = |column: &Column| match column {
        Column::Words(_) => "",
        Column::Numbers(..) => " class=\"n\"",
    };
    let head: String = columns
        .iter()
        .map(|column| match column {
            Column::Words(name) => format!("<th scope=\"col\">{}</th>", escape(name)),
            Column::Numbers(name, "") => format!("<th scope=\"col\" class=\"n\">{}</th>", escape(name)),
            Column::Numbers(name, unit) => {
                format!("<th scope=\"col\" class=\"n\">{} <small>{}</small></th>", escape(name), escape(unit))
            }
        })
        .collect();
    let body: String = rows
        .iter()
        .map(|row| {
            let cells: String = row
                .iter()
                .zip(columns)
                .enumerate()
                .map(|(k, (cell, column))| match k {
                    0 => format!("<th scope=\"row\">{cell}</th>"),
                    _ => format!("<td{}>{cell}</td>", class(column)),
                })
                .collect();
            format!("<tr>{cells}</tr>\n")
        })
        .collect();
    format!(
        "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{caption}\"><table><caption>{caption}</caption>\
         <thead><tr>{head}</tr></thead>\n<tbody>\n{body}</tbody></table></div>\n",
        caption = escape(caption)
    )
}

/// A section with a heading; empty content makes no section.
pub(crate) fn section(id: &str, heading: &str, content: &str) -> String {
    if content.is_empty() {
        return String::new();
    }
    format!(
        "<section aria-labelledby=\"{id}\"><h2 id=\"{id}\">{}</h2>\n{content}</section>\n",
        escape(heading)
    )
}

/// A verdict in a word and a colour; the word carries the meaning.
pub(crate) fn verdict(class: &str, word: &str) -> String {
    format!("<span class=\"verdict {class}\">{}</span>", escape(word))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn backticks_mark_names() {
        assert_eq!(prose("set `a<b` to 1"), "set <code>a&lt;b</code> to 1");
        assert_eq!(prose("5` is odd & left"), "5` is odd &amp; left");
        assert_eq!(prose(""), "");
    }

    #[test]
    fn names_cannot_become_markup() {
        let hostile = "<script>alert('x')</script> & \"more\"";
        let safe = escape(hostile);
        assert!(!safe.contains('<') && !safe.contains('"') && !safe.contains('\''), "{safe}");
        let html = table(hostile, &[Column::Words("name")], &[vec![escape(hostile)]]);
        assert!(!html.contains("<script"), "{html}");
    }
}
