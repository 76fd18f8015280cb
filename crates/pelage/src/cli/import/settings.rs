//! Names and values in a text: MEL commands as Maya writes them, or a name and its values
//! on each line.

/// A value that the text gives to a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// From 1.
    pub line: usize,
    /// Without the node before it and the index behind it.
    pub name: String,
    /// The values, as written.
    pub values: Vec<String>,
}

/// What a text holds.
#[derive(Debug, Default)]
pub struct Settings {
    /// In the order of the text; of a scene, those of its first hair.
    pub all: Vec<Setting>,
    /// Lines where more hairs of the scene begin.
    pub others: Vec<usize>,
}

/// Most words that are kept of a statement: no property has many values, but guides do.
const MOST_WORDS: usize = 32;

/// Longest word that is kept.
const LONGEST_WORD: usize = 200;

/// Flags of `setAttr` that have no argument.
const LONE_FLAGS: [&str; 4] = ["-av", "-alteredValue", "-c", "-clamp"];

/// The settings of `text`; `is_hair` knows the types of the nodes that are meant.
pub fn settings(text: &str, is_hair: impl Fn(&str) -> bool) -> Settings {
    let mut found = Settings::default();
    if !text
        .lines()
        .any(|line| line.trim_start().starts_with("setAttr"))
    {
        found.all = text.lines().enumerate().filter_map(plain).collect();
        return found;
    }
    // A script that makes no node has none but the one that is asked for.
    let mut node = Node::Unnamed;
    each_statement(text, |line, words| match words[0].as_str() {
        "createNode" if words.get(1).is_some_and(|kind| is_hair(kind)) => {
            if matches!(node, Node::Hair | Node::After) {
                found.others.push(line);
            }
            node = node.then(true);
        }
        "createNode" | "select" => node = node.then(false),
        "setAttr" if matches!(node, Node::Unnamed | Node::Hair) => {
            found.all.extend(set_attr(line, words));
        }
        _ => {}
    });
    found
}

/// Whose settings a scene is at.
#[derive(Clone, Copy)]
enum Node {
    /// No node was named yet.
    Unnamed,
    /// A node before the first hair.
    Before,
    /// The first hair.
    Hair,
    /// Any node after it.
    After,
}

impl Node {
    fn then(self, is_hair: bool) -> Self {
        match self {
            Node::Unnamed | Node::Before if is_hair => Node::Hair,
            Node::Unnamed | Node::Before => Node::Before,
            Node::Hair | Node::After => Node::After,
        }
    }
}

/// `name = values` or `name values`; nothing for other lines.
fn plain((index, line): (usize, &str)) -> Option<Setting> {
    let line = line.split("//").next()?.split('#').next()?;
    let separates = |c: char| c.is_whitespace() || "=,;:()[]{}\"'".contains(c);
    let mut words = line.split(separates).filter(|word| !word.is_empty());
    let name = bare(words.next()?)?;
    let values: Vec<String> = words.take(MOST_WORDS).map(shortened).collect();
    (!values.is_empty()).then_some(Setting {
        line: index + 1,
        name,
        values,
    })
}

/// `setAttr [flags] name [flags] values`.
fn set_attr(line: usize, words: &[String]) -> Option<Setting> {
    let mut words = words[1..].iter();
    let mut plain = Vec::new();
    while let Some(word) = words.next() {
        let is_flag = word.starts_with('-') && word[1..].starts_with(|c: char| c.is_alphabetic());
        if !is_flag {
            plain.push(word.clone());
        } else if !LONE_FLAGS.contains(&word.as_str()) {
            words.next();
        }
    }
    let values = plain.split_off(plain.len().min(1));
    let name = bare(plain.first()?)?;
    (!values.is_empty()).then_some(Setting { line, name, values })
}

/// The last part of `node.name[index]`, if it can be a name.
fn bare(word: &str) -> Option<String> {
    let (_, name) = word.rsplit_once('.').unwrap_or(("", word));
    let name = name.split('[').next()?;
    let allowed = |c: char| c.is_ascii_alphanumeric() || "_/-".contains(c);
    let is_name = name.starts_with(|c: char| c.is_ascii_alphabetic()) && name.chars().all(allowed);
    (is_name && name.len() <= LONGEST_WORD).then(|| name.to_owned())
}

fn shortened(word: &str) -> String {
    word.chars().take(LONGEST_WORD).collect()
}

/// Calls `take` with the line and the words of each MEL statement.
fn each_statement(text: &str, mut take: impl FnMut(usize, &[String])) {
    let mut words = Words::default();
    let mut line = 1;
    let mut characters = text.chars().peekable();
    let mut quoted = false;
    while let Some(c) = characters.next() {
        match c {
            '\\' if quoted => words.push(line, characters.next().unwrap_or(' ')),
            '"' => {
                quoted = !quoted;
                words.end();
            }
            _ if quoted => words.push(line, c),
            ';' => words.finish(&mut take),
            '/' if characters.peek() == Some(&'/') => {
                while characters.next_if(|c| *c != '\n').is_some() {}
                words.end();
            }
            c if c.is_whitespace() => words.end(),
            c => words.push(line, c),
        }
        line += usize::from(c == '\n');
    }
    words.finish(&mut take);
}

/// The words of a statement in the making.
#[derive(Default)]
struct Words {
    line: usize,
    done: Vec<String>,
    word: String,
}

impl Words {
    fn push(&mut self, line: usize, c: char) {
        if self.done.is_empty() && self.word.is_empty() {
            self.line = line;
        }
        if self.word.len() < LONGEST_WORD {
            self.word.push(c);
        }
    }

    fn end(&mut self) {
        if !self.word.is_empty() && self.done.len() < MOST_WORDS {
            self.done.push(std::mem::take(&mut self.word));
        }
        self.word.clear();
    }

    fn finish(&mut self, take: &mut impl FnMut(usize, &[String])) {
        self.end();
        if !self.done.is_empty() {
            take(self.line, &self.done);
        }
        self.done.clear();
    }
}
