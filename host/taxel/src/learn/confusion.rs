//! Confusion matrix.

use serde_json::{Map, Value, json};

/// Counts of answers.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Confusion {
    /// Names of the true classes.
    pub classes: Vec<String>,
    /// Names of the answers; the last is "none".
    pub answers: Vec<String>,
    /// A row for each class, a column for each answer.
    pub counts: Vec<Vec<u32>>,
}

impl Confusion {
    /// An empty matrix.
    pub fn new(classes: &[String], known: &[String]) -> Confusion {
        let answers: Vec<String> = known.iter().cloned().chain(["none".to_string()]).collect();
        Confusion { classes: classes.to_vec(), counts: vec![vec![0; answers.len()]; classes.len()], answers }
    }

    /// Counts an answer: an index of the known classes, or none.
    pub fn count(&mut self, class: usize, answer: Option<usize>) {
        let column = answer.unwrap_or(self.answers.len() - 1);
        self.counts[class][column] += 1;
    }

    /// True if an answer is right; for a class that was not taught, the right answer is none.
    pub fn is_right(&self, class: usize, answer: Option<usize>) -> bool {
        answer == self.answers.iter().position(|name| *name == self.classes[class])
    }

    /// Answers to a class: name, count, and whether it is right.
    fn row(&self, class: usize) -> impl Iterator<Item = (&str, u32, bool)> {
        let none = self.answers.len() - 1;
        self.counts[class].iter().enumerate().map(move |(answer, count)| {
            let right = self.is_right(class, (answer != none).then_some(answer));
            (self.answers[answer].as_str(), *count, right)
        })
    }

    fn right(&self, class: usize) -> u32 {
        self.row(class).filter(|(_, _, right)| *right).map(|(_, count, _)| count).sum()
    }

    /// Number of answers.
    pub fn all(&self) -> u32 {
        self.counts.iter().flatten().sum()
    }

    /// Share of right answers.
    pub fn accuracy(&self) -> f64 {
        let right: u32 = (0..self.classes.len()).map(|class| self.right(class)).sum();
        f64::from(right) / f64::from(self.all().max(1))
    }

    /// `accuracy`, `chance` (the most frequent class), `classes`, `answers`, `confusion`, `by_class`.
    pub fn figures(&self) -> Map<String, Value> {
        let sizes: Vec<u32> = self.counts.iter().map(|row| row.iter().sum()).collect();
        let most = sizes.iter().copied().max().unwrap_or(0);
        let share = |part: u32, all: u32| f64::from(part) / f64::from(all.max(1));
        let by_class = self
            .classes
            .iter()
            .enumerate()
            .map(|(class, name)| (name.clone(), json!(share(self.right(class), sizes[class]))));
        let figures = json!({
            "accuracy": self.accuracy(),
            "chance": share(most, self.all()),
            "classes": self.classes,
            "answers": self.answers,
            "confusion": self.counts,
            "by_class": Value::Object(by_class.collect()),
        });
        figures.as_object().cloned().unwrap_or_default()
    }

    /// Classes with their right answers and their most frequent wrong ones.
    pub fn table(&self) -> String {
        let width = self.classes.iter().map(String::len).max().unwrap_or(0);
        let line = |class: usize| {
            let all: u32 = self.counts[class].iter().sum();
            let mut wrong: Vec<_> =
                self.row(class).filter(|(_, count, right)| *count > 0 && !right).collect();
            wrong.sort_by_key(|(_, count, _)| std::cmp::Reverse(*count));
            let wrong = wrong.iter().take(3).map(|(answer, count, _)| format!("{answer} {count}"));
            let wrong = wrong.collect::<Vec<_>>().join(", ");
            let line =
                format!("{:width$}  {:>4} of {all:<4} {wrong}", self.classes[class], self.right(class));
            format!("{}\n", line.trim_end())
        };
        (0..self.classes.len()).map(line).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_class_that_nobody_taught_is_right_as_none() {
        let names = |names: &[&str]| names.iter().map(ToString::to_string).collect::<Vec<_>>();
        let mut confusion = Confusion::new(&names(&["box", "cup"]), &names(&["ball", "box"]));
        for (class, answer) in [(0, Some(1)), (0, Some(1)), (0, Some(0)), (1, None), (1, Some(1))] {
            confusion.count(class, answer);
        }
        assert_eq!(confusion.counts, [[1, 2, 0], [0, 1, 1]]);
        assert_eq!((confusion.accuracy(), confusion.figures()["chance"].as_f64()), (0.6, Some(0.6)));
        assert_eq!(confusion.table(), "box     2 of 3    ball 1\ncup     1 of 2    box 1\n");
    }
}
