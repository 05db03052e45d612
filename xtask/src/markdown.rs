//! Parses Markdown documents for checks.

/// A parsed document.
#[derive(Debug, Default)]
pub struct Markdown {
    /// Targets of links: the headings, with the names that GitHub gives them.
    pub anchors: Vec<String>,
    pub links: Vec<Spot>,
    /// Code between single backticks, outside of blocks.
    pub code: Vec<Spot>,
    pub blocks: Vec<Block>,
}

/// A piece of text with its line number, from 1.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Spot {
    pub line: usize,
    pub text: String,
}

/// A fenced block.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Block {
    /// Line number of its first line of text, from 1.
    pub line: usize,
    /// The word after the fence; empty if there is none.
    pub tag: String,
    pub text: String,
}

impl Markdown {
    /// Parses a text.
    pub fn parse(text: &str) -> Self {
        let mut document = Self::default();
        let mut prose = String::new();
        let mut open: Option<Block> = None;
        for (number, line) in (1..).zip(text.lines()) {
            let fence = line.trim_start().strip_prefix("```");
            match (&mut open, fence) {
                (None, Some(tag)) => {
                    let tag = tag.trim().to_owned();
                    open = Some(Block { line: number + 1, tag, text: String::new() });
                }
                (Some(_), Some(_)) => document.blocks.extend(open.take()),
                (Some(block), None) => {
                    block.text.push_str(line);
                    block.text.push('\n');
                }
                (None, None) => {
                    document.add_heading(line);
                    prose.push_str(line);
                }
            }
            // Lines of blocks stay empty in the prose, so that other lines keep their numbers.
            prose.push('\n');
        }
        document.read_prose(&prose);
        document
    }

    fn add_heading(&mut self, line: &str) {
        let text = line.trim_start_matches('#');
        if text.len() == line.len() || !text.starts_with(' ') {
            return;
        }
        let name = anchor_of(text.trim());
        let again = self.anchors.iter().filter(|anchor| without_count(anchor) == name).count();
        self.anchors.push(if again == 0 { name } else { format!("{name}-{again}") });
    }

    /// Finds links and code, which may continue on the next line.
    fn read_prose(&mut self, prose: &str) {
        let mut line = 1;
        for (number, part) in prose.split('`').enumerate() {
            if number % 2 == 1 {
                let text = part.split_whitespace().collect::<Vec<_>>().join(" ");
                self.code.push(Spot { line, text });
            } else {
                self.links.extend(links_of(part, line));
            }
            line += part.matches('\n').count();
        }
    }
}

/// Returns the targets of links in a text that begins on line `first_line`.
fn links_of(text: &str, first_line: usize) -> Vec<Spot> {
    let starts = text.match_indices("](");
    let link = |(at, _): (usize, &str)| {
        let line = first_line + text[..at].matches('\n').count();
        let target = text[at + 2..].split_once(')')?.0;
        Some(Spot { line, text: target.to_owned() })
    };
    starts.filter_map(link).collect()
}

/// Returns GitHub's name of a heading in an address.
fn anchor_of(heading: &str) -> String {
    let is_kept = |letter: &char| letter.is_alphanumeric() || " -_".contains(*letter);
    let letters = heading.chars().flat_map(char::to_lowercase).filter(is_kept);
    letters.map(|letter| if letter == ' ' { '-' } else { letter }).collect()
}

/// Returns an anchor without the number that distinguishes equal headings.
fn without_count(anchor: &str) -> &str {
    match anchor.rsplit_once('-') {
        Some((name, count)) if count.parse::<u32>().is_ok() => name,
        _ => anchor,
    }
}

#[cfg(test)]
mod tests {
    use super::{Markdown, Spot};

    const TEXT: &str = "\
# The rule `exact`

See [a](b.md#c) and ![a picture](d.png), `World::step`, a `long
name` over two lines.

```sh
carom run `x`   # no [link](x.md)
```
## Limits
## Limits
";

    #[test]
    fn headings_are_named_as_github_does() {
        assert_eq!(Markdown::parse(TEXT).anchors, ["the-rule-exact", "limits", "limits-1"]);
    }

    #[test]
    fn links_and_code_are_found_outside_of_blocks() {
        let document = Markdown::parse(TEXT);
        let spot = |line, text: &str| Spot { line, text: text.to_owned() };
        assert_eq!(document.links, [spot(3, "b.md#c"), spot(3, "d.png")]);
        let code = [spot(1, "exact"), spot(3, "World::step"), spot(3, "long name")];
        assert_eq!(document.code, code);
    }

    #[test]
    fn blocks_keep_tag_text_and_line() {
        let document = Markdown::parse(TEXT);
        let [block] = &document.blocks[..] else { panic!("{:?}", document.blocks) };
        assert_eq!((block.line, block.tag.as_str()), (7, "sh"));
        assert_eq!(block.text, "carom run `x`   # no [link](x.md)\n");
    }
}
