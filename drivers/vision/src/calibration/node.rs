//! What a file says, whatever its form: texts, lists and named entries, each with its line.

use nalgebra::Vector2;

use super::fault::Reason;

/// A value of a file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Node {
    /// Where it begins, from one.
    pub(crate) line: usize,
    pub(crate) value: Value,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    Text(String),
    List(Vec<Node>),
    Map(Vec<(String, Node)>),
}

impl Node {
    pub(crate) fn text(line: usize, text: &str) -> Self {
        Node { line, value: Value::Text(text.to_owned()) }
    }

    pub(crate) fn entries(&self) -> &[(String, Node)] {
        if let Value::Map(entries) = &self.value { entries } else { &[] }
    }

    pub(crate) fn get(&self, name: &str) -> Option<&Node> {
        self.entries().iter().find(|(own, _)| own == name).map(|(_, node)| node)
    }

    pub(crate) fn need(&self, name: &str) -> Result<&Node, Reason> {
        self.get(name).ok_or_else(|| Reason::new(self.line, name, "is missing"))
    }

    /// A word, without quotes.
    pub(crate) fn word(&self, name: &str) -> Result<&str, Reason> {
        match &self.value {
            Value::Text(text) if !text.is_empty() => Ok(text),
            _ => Err(Reason::new(self.line, name, "wants a word")),
        }
    }

    /// All numbers of a list, of lists of lists, or of a text with spaces between them.
    pub(crate) fn numbers(&self, name: &str) -> Result<Vec<f64>, Reason> {
        match &self.value {
            Value::Text(text) if !text.is_empty() => {
                text.split_whitespace().map(|word| self.number_of(name, word)).collect()
            }
            Value::List(items) => {
                let parts: Result<Vec<_>, _> =
                    items.iter().map(|item| item.numbers(name)).collect();
                Ok(parts?.concat())
            }
            Value::Text(_) | Value::Map(_) => Err(Reason::new(self.line, name, "wants numbers")),
        }
    }

    fn number_of(&self, name: &str, word: &str) -> Result<f64, Reason> {
        let number = word.parse::<f64>().ok().filter(|number| number.is_finite());
        number.ok_or_else(|| Reason::new(self.line, name, &format!("{word} is no number")))
    }

    /// So many numbers.
    pub(crate) fn array<const N: usize>(&self, name: &str) -> Result<[f64; N], Reason> {
        let numbers = self.numbers(name)?;
        let has = numbers.len();
        let wrong = |_| Reason::new(self.line, name, &format!("wants {N} numbers, has {has}"));
        numbers.try_into().map_err(wrong)
    }

    /// A side of an image, px.
    pub(crate) fn side(&self, name: &str) -> Result<u32, Reason> {
        let [side] = self.array::<1>(name)?;
        self.checked_side(name, side)
    }

    /// Width and height of an image, px.
    pub(crate) fn sides(&self, name: &str) -> Result<[u32; 2], Reason> {
        let [width, height] = self.array::<2>(name)?;
        Ok([self.checked_side(name, width)?, self.checked_side(name, height)?])
    }

    fn checked_side(&self, name: &str, side: f64) -> Result<u32, Reason> {
        let whole = side.fract() == 0.0 && (1.0..=65_535.0).contains(&side);
        let wrong = || Reason::new(self.line, name, &format!("{side} is no count of pixels"));
        whole.then_some(side as u32).ok_or_else(wrong)
    }

    /// Focal lengths and centre as they may be for an image of this size.
    pub(crate) fn checked_axes(
        &self,
        name: &str,
        [fx, fy, cx, cy]: [f64; 4],
        size: [u32; 2],
    ) -> Result<(Vector2<f64>, Vector2<f64>), Reason> {
        if fx <= 0.0 || fy <= 0.0 {
            return Err(Reason::new(self.line, name, "focal lengths are positive"));
        }
        let within = |at: f64, side: u32| (0.0..=f64::from(side)).contains(&at);
        if !within(cx, size[0]) || !within(cy, size[1]) {
            return Err(Reason::new(
                self.line,
                name,
                &format!("the centre {cx}, {cy} lies outside the image"),
            ));
        }
        Ok((Vector2::new(fx, fy), Vector2::new(cx, cy)))
    }
}
