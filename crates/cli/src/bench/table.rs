//! A table of figures: as text, as Markdown, as JSON.

use serde_json::{Map, Value, json};

/// One figure or name.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Cell {
    Text(String),
    Whole(u64),
    Number(f64),
    /// Milliseconds of passes, by name.
    Passes(Vec<(&'static str, f64)>),
    /// There is none.
    None,
}

impl From<Option<f64>> for Cell {
    fn from(number: Option<f64>) -> Self {
        number.map_or(Cell::None, Cell::Number)
    }
}

impl Cell {
    fn text(&self) -> String {
        match self {
            Cell::Text(text) => text.clone(),
            Cell::Whole(n) => n.to_string(),
            Cell::Number(x) => three_digits(*x),
            Cell::Passes(passes) => {
                let passes: Vec<String> =
                    passes.iter().map(|(name, ms)| format!("{name} {}", three_digits(*ms))).collect();
                if passes.is_empty() { "-".into() } else { passes.join(", ") }
            }
            Cell::None => "-".into(),
        }
    }

    fn json(&self) -> Value {
        match self {
            Cell::Text(text) => json!(text),
            Cell::Whole(n) => json!(n),
            Cell::Number(x) => json!(x),
            Cell::Passes(passes) if passes.is_empty() => Value::Null,
            Cell::Passes(passes) => {
                passes.iter().map(|(name, ms)| ((*name).to_owned(), json!(ms))).collect::<Map<_, _>>().into()
            }
            Cell::None => Value::Null,
        }
    }

    fn is_text(&self) -> bool {
        matches!(self, Cell::Text(_))
    }
}

/// At least three digits that count: 1234, 123, 12.3, 1.23, 0.0123.
fn three_digits(x: f64) -> String {
    match x.abs() {
        0.0 => "0".into(),
        a if (1e-4..1e6).contains(&a) => {
            let digits = (2.0 - a.log10().floor()).max(0.0) as usize;
            format!("{x:.digits$}")
        }
        _ => format!("{x:.2e}"),
    }
}

/// A column: its key in JSON and its heading.
pub(super) type Column = (&'static str, &'static str);

/// Rows under headings.
#[derive(Clone, Debug)]
pub(super) struct Table {
    pub(super) columns: Vec<Column>,
    pub(super) rows: Vec<Vec<Cell>>,
    /// How it was measured: names and values.
    pub(super) settings: Vec<(&'static str, String)>,
}

impl Table {
    /// One more setting.
    pub(super) fn with(mut self, name: &'static str, value: String) -> Self {
        self.settings.push((name, value));
        self
    }

    /// Columns flush, two blanks between them; settings above.
    pub(super) fn plain(&self) -> String {
        let widths = self.widths();
        let line = |cells: &[String], rows: &[bool]| {
            let padded = cells.iter().zip(&widths).zip(rows).map(|((cell, &w), left)| {
                let blanks = " ".repeat(w - cell.chars().count());
                if *left { format!("{cell}{blanks}") } else { format!("{blanks}{cell}") }
            });
            padded.collect::<Vec<_>>().join("  ").trim_end().to_owned()
        };
        let settings = self.settings.iter().map(|(name, value)| format!("{name}: {value}"));
        let left = self.flush_left();
        let head: Vec<String> = self.columns.iter().map(|c| c.1.to_owned()).collect();
        let rows = self.texts();
        let rows = std::iter::once(&head).chain(&rows).map(|cells| line(cells, &left));
        settings.chain([String::new()]).chain(rows).collect::<Vec<_>>().join("\n")
    }

    /// A table of GitHub's Markdown; settings below.
    pub(super) fn markdown(&self) -> String {
        let row = |cells: &mut dyn Iterator<Item = String>| {
            let cells: Vec<String> = cells.map(|c| c.replace('|', "\\|")).collect();
            format!("| {} |", cells.join(" | "))
        };
        let head = row(&mut self.columns.iter().map(|c| c.1.to_owned()));
        let left = self.flush_left();
        let rule = row(&mut left.iter().map(|l| if *l { "---".into() } else { "---:".into() }));
        let rows = self.texts().into_iter().map(|cells| row(&mut cells.into_iter()));
        let settings: Vec<String> =
            self.settings.iter().map(|(name, value)| format!("{name}: {value}")).collect();
        let lines: Vec<String> = [head, rule].into_iter().chain(rows).collect();
        format!("{}\n\n{}.", lines.join("\n"), settings.join("; "))
    }

    /// One object; numbers in full.
    pub(super) fn json(&self) -> String {
        let row = |cells: &Vec<Cell>| -> Value {
            let pairs = self.columns.iter().zip(cells);
            pairs.map(|((key, _), cell)| (key.to_string(), cell.json())).collect::<Map<_, _>>().into()
        };
        let settings: Map<_, _> =
            self.settings.iter().map(|(name, value)| (name.replace(' ', "_"), json!(value))).collect();
        json!({
            "version": env!("CARGO_PKG_VERSION"),
            "settings": settings,
            "rows": self.rows.iter().map(row).collect::<Vec<_>>(),
        })
        .to_string()
    }

    fn texts(&self) -> Vec<Vec<String>> {
        self.rows.iter().map(|row| row.iter().map(Cell::text).collect()).collect()
    }

    fn widths(&self) -> Vec<usize> {
        let rows = self.texts();
        let width = |i: usize| {
            let heading = self.columns[i].1.chars().count();
            rows.iter().map(|r| r[i].chars().count()).fold(heading, usize::max)
        };
        (0..self.columns.len()).map(width).collect()
    }

    /// Columns of words.
    fn flush_left(&self) -> Vec<bool> {
        (0..self.columns.len()).map(|i| self.rows.iter().any(|r| r[i].is_text())).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        Table {
            columns: vec![("scene", "scene"), ("fps", "fps"), ("length", "path length"), ("spp", "spp")],
            rows: vec![
                vec![Cell::Text("a|b".into()), Cell::Number(12.345), Cell::None, Cell::Whole(1)],
                vec![Cell::Text("pool".into()), Cell::Number(1234.5), Cell::Number(0.25), Cell::Whole(1000)],
            ],
            settings: vec![("device", "CPU".into()), ("first thing", "4".into())],
        }
    }

    #[test]
    fn numbers_have_three_digits() {
        for (x, text) in [
            (0.0, "0"),
            (123_456.7, "123457"),
            (123.4, "123"),
            (12.34, "12.3"),
            (1.234, "1.23"),
            (0.012_34, "0.0123"),
            (-0.5, "-0.500"),
            (1.5e-7, "1.50e-7"),
            (2e9, "2.00e9"),
        ] {
            assert_eq!(three_digits(x), text);
        }
    }

    #[test]
    fn passes_have_their_names() {
        let none = Cell::Passes(Vec::new());
        assert_eq!((none.text(), none.json()), ("-".into(), Value::Null));
        let two = Cell::Passes(vec![("trace", 3.25), ("tone", 0.125)]);
        assert_eq!(two.text(), "trace 3.25, tone 0.125");
        assert_eq!(two.json(), json!({ "trace": 3.25, "tone": 0.125 }));
    }

    #[test]
    fn text_is_aligned() {
        let said = table().plain();
        let lines: Vec<&str> = said.lines().collect();
        assert_eq!(lines[..3], ["device: CPU", "first thing: 4", ""]);
        assert_eq!(lines[3], "scene   fps  path length   spp");
        assert_eq!(lines[4], "a|b    12.3            -     1");
        assert_eq!(lines[5], "pool   1234        0.250  1000");
    }

    #[test]
    fn markdown_is_a_table() {
        let said = table().markdown();
        let lines: Vec<&str> = said.lines().collect();
        assert_eq!(lines[0], "| scene | fps | path length | spp |");
        assert_eq!(lines[1], "| --- | ---: | ---: | ---: |");
        assert_eq!(lines[2], "| a\\|b | 12.3 | - | 1 |");
        assert_eq!(lines[5], "device: CPU; first thing: 4.");
    }

    #[test]
    fn json_keeps_all_digits() {
        let parsed: Value = serde_json::from_str(&table().json()).unwrap();
        assert_eq!(parsed["rows"][1]["fps"], 1234.5);
        assert!(parsed["rows"][0]["length"].is_null());
        assert_eq!(
            (&parsed["rows"][1]["spp"], &parsed["settings"]["first_thing"]),
            (&1000.into(), &"4".into())
        );
    }
}
