//! A chart as SVG: points of several series on two logarithmic axes, with the Pareto front of each.

use std::fmt::Write;

const PAPER: &str = "#12141a";
const INK: &str = "#d8dee9";
const GRID: &str = "#2e3440";
/// Colours of the series, in turn.
const COLOURS: [&str; 6] = ["#88c0d0", "#ebcb8b", "#a3be8c", "#b48ead", "#d08770", "#bf616a"];
/// Size of the picture, SVG units.
const SIZE: [f64; 2] = [880.0, 520.0];
/// Left, top, right and bottom of the plot area.
const FRAME: [f64; 4] = [80.0, 48.0, 660.0, 460.0];
/// Height of the strip at the low end of an axis for values of 0, which have no logarithm.
const ZERO: f64 = 24.0;
/// Axes with more decades than this have marks at decades only, because closer ones would overlap.
const DECADES_WITH_STEPS: i32 = 2;

/// The better end of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Better {
    /// Less is better: an error, a time.
    Less,
    /// More is better: a rate.
    More,
}

/// A logarithmic axis.
#[derive(Debug, Clone)]
pub struct Axis {
    /// Quantity and unit.
    pub label: String,
    /// Its better end.
    pub better: Better,
}

/// A series of points.
#[derive(Debug, Clone)]
pub struct Series {
    /// Name in the legend.
    pub name: String,
    /// x, y (not negative) and the tooltip of the point; see [`Chart::named`].
    pub points: Vec<(f64, f64, String)>,
}

/// A chart.
#[derive(Debug, Clone)]
pub struct Chart {
    /// Title.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// True if the points of the front are labelled with the text of their tooltip before its first colon.
    pub named: bool,
    /// The series.
    pub series: Vec<Series>,
}

impl Axis {
    /// An axis with this label.
    pub fn new(label: &str, better: Better) -> Axis {
        Axis { label: label.into(), better }
    }

    fn beats(&self, a: f64, b: f64) -> bool {
        match self.better {
            Better::Less => a < b,
            Better::More => a > b,
        }
    }
}

impl Chart {
    /// Pareto front of a series: indices of the points that no other point betters on one axis without being
    /// worse on the other, from left to right.
    pub fn front(&self, series: &Series) -> Vec<usize> {
        let beaten = |a: &(f64, f64, String), b: &(f64, f64, String)| {
            let no_worse = !self.x.beats(a.0, b.0) && !self.y.beats(a.1, b.1);
            no_worse && (self.x.beats(b.0, a.0) || self.y.beats(b.1, a.1))
        };
        let points = series.points.iter().enumerate();
        let mut front: Vec<(usize, f64)> = points
            .filter(|(_, point)| !series.points.iter().any(|other| beaten(point, other)))
            .map(|(index, point)| (index, point.0))
            .collect();
        front.sort_by(|a, b| a.1.total_cmp(&b.1));
        front.into_iter().map(|(index, _)| index).collect()
    }

    /// Draws the chart.
    pub fn svg(&self) -> String {
        let all = || self.series.iter().flat_map(|series| &series.points);
        let [left, top, right, bottom] = FRAME;
        let x = Scale::over(all().map(|p| p.0), left, right);
        let y = Scale::over(all().map(|p| p.1), bottom, top);
        let [width, height] = SIZE;
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
             font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"{INK}\">\n\
             <rect width=\"100%\" height=\"100%\" rx=\"6\" fill=\"{PAPER}\"/>\n\
             <text x=\"{left}\" y=\"28\" font-size=\"15\">{}</text>\n",
            escaped(&self.title)
        );
        // Writing to a string cannot fail.
        let _ = self.axes(&x, &y, &mut svg);
        let below = FRAME[1] + 12.0 + 22.0 * self.series.len() as f64;
        svg += &format!(
            "<text x=\"{}\" y=\"{}\" font-size=\"11\">filled: nothing betters it</text>\n",
            FRAME[2] + 20.0,
            below + 4.0
        );
        for (number, series) in self.series.iter().enumerate() {
            let colour = COLOURS.get(number % COLOURS.len()).unwrap_or(&INK);
            let _ = self.draw(series, colour, number, [&x, &y], &mut svg);
        }
        svg + "</svg>\n"
    }

    fn axes(&self, x: &Scale, y: &Scale, svg: &mut String) -> std::fmt::Result {
        let [left, top, right, bottom] = FRAME;
        for (at, name) in x.marks() {
            writeln!(svg, "<path d=\"M{at:.1} {top}V{bottom}\" stroke=\"{GRID}\"/>")?;
            writeln!(
                svg,
                "<text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{name}</text>",
                bottom + 18.0
            )?;
        }
        for (at, name) in y.marks() {
            writeln!(svg, "<path d=\"M{left} {at:.1}H{right}\" stroke=\"{GRID}\"/>")?;
            writeln!(
                svg,
                "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{name}</text>",
                left - 8.0,
                at + 4.0
            )?;
        }
        let (across, up) = ((left + right) / 2.0, (top + bottom) / 2.0);
        let (label, below) = (escaped(&self.x.label), bottom + 42.0);
        writeln!(svg, "<text x=\"{across}\" y=\"{below}\" text-anchor=\"middle\">{label}</text>")?;
        let label = escaped(&self.y.label);
        writeln!(
            svg,
            "<text transform=\"translate(22 {up}) rotate(-90)\" text-anchor=\"middle\">{label}</text>"
        )
    }

    /// Draws a series: its points, those of the front filled and connected, and its line in the legend.
    fn draw(
        &self,
        series: &Series,
        colour: &str,
        number: usize,
        [x, y]: [&Scale; 2],
        svg: &mut String,
    ) -> std::fmt::Result {
        let front = self.front(series);
        let at = |point: &(f64, f64, String)| (x.place(point.0), y.place(point.1));
        let path: Vec<String> = front
            .iter()
            .filter_map(|index| series.points.get(*index))
            .map(|point| format!("{:.1} {:.1}", at(point).0, at(point).1))
            .collect();
        if path.len() > 1 {
            writeln!(svg, "<path d=\"M{}\" fill=\"none\" stroke=\"{colour}\"/>", path.join("L"))?;
        }
        for (index, point) in series.points.iter().enumerate() {
            let ((cx, cy), name) = (at(point), escaped(&point.2));
            let in_front = front.contains(&index);
            let (r, fill) = if in_front { (4.5, colour) } else { (3.0, "none") };
            writeln!(
                svg,
                "<circle cx=\"{cx:.1}\" cy=\"{cy:.1}\" r=\"{r}\" fill=\"{fill}\" stroke=\"{colour}\"><title>{name}</title></circle>"
            )?;
            if let (true, Some((short, _))) = (self.named && in_front, name.split_once(':')) {
                let (x, y) = (cx + 8.0, cy - 6.0);
                writeln!(
                    svg,
                    "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"11\" fill=\"{colour}\">{short}</text>"
                )?;
            }
        }
        let (left, line) = (FRAME[2] + 24.0, FRAME[1] + 12.0 + 22.0 * number as f64);
        writeln!(svg, "<circle cx=\"{left}\" cy=\"{line}\" r=\"4.5\" fill=\"{colour}\"/>")?;
        writeln!(svg, "<text x=\"{}\" y=\"{}\">{}</text>", left + 12.0, line + 4.0, escaped(&series.name))
    }
}

/// Maps values to places of the picture.
struct Scale {
    /// Powers of ten at the two ends, and their places.
    decades: [i32; 2],
    places: [f64; 2],
    /// Place of 0, if it occurs.
    zero: Option<f64>,
}

impl Scale {
    /// A scale for all values, between two places.
    fn over(values: impl Iterator<Item = f64> + Clone, from: f64, to: f64) -> Scale {
        let positive = || values.clone().filter(|value| *value > 0.0);
        let low = positive().min_by(f64::total_cmp).unwrap_or(1.0).log10().floor() as i32;
        let high = positive().max_by(f64::total_cmp).unwrap_or(1.0).log10().ceil() as i32;
        let zero = values.clone().any(|value| value == 0.0).then_some(from);
        let from = if zero.is_some() { from + ZERO * (to - from).signum() } else { from };
        Scale { decades: [low, high.max(low + 1)], places: [from, to], zero }
    }

    fn place(&self, value: f64) -> f64 {
        if value <= 0.0 {
            return self.zero.unwrap_or(self.places[0]);
        }
        let [low, high] = self.decades.map(f64::from);
        let share = (value.log10() - low) / (high - low);
        self.places[0] + share * (self.places[1] - self.places[0])
    }

    /// Places and names of the marks: decades, with 2 and 5 between them if there is room.
    fn marks(&self) -> Vec<(f64, String)> {
        let [low, high] = self.decades;
        let steps: &[f64] = if high - low <= DECADES_WITH_STEPS { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let zero = self.zero.map(|at| (at, "0".to_string()));
        let decade = |power: i32| steps.iter().map(move |step| step * 10f64.powi(power));
        let marks = (low..high).flat_map(decade).chain([10f64.powi(high)]);
        zero.into_iter().chain(marks.map(|value| (self.place(value), named(value)))).collect()
    }
}

/// Name of a mark, with as few digits as possible.
fn named(value: f64) -> String {
    if (1e-3..1e5).contains(&value) { format!("{value}") } else { format!("{value:.0e}") }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart(better: Better, points: &[(f64, f64)]) -> Chart {
        let points = points.iter().map(|(x, y)| (*x, *y, format!("p{x}: {x} < {y}"))).collect();
        Chart {
            title: "a & b".into(),
            x: Axis::new("cost", better),
            y: Axis::new("error", Better::Less),
            named: true,
            series: vec![Series { name: "all".into(), points }],
        }
    }

    #[test]
    fn the_front_is_what_nothing_betters() {
        let points = [(1.0, 9.0), (2.0, 3.0), (3.0, 3.0), (4.0, 0.0), (5.0, 1.0)];
        let less = chart(Better::Less, &points);
        assert_eq!(less.front(&less.series[0]), [0, 1, 3]);
        let more = chart(Better::More, &points);
        assert_eq!(more.front(&more.series[0]), [3, 4]);
        let same = chart(Better::Less, &[(1.0, 1.0), (1.0, 1.0)]);
        assert_eq!(same.front(&same.series[0]), [0, 1], "equal points do not beat each other");
    }

    #[test]
    fn values_lie_by_their_logarithm_and_zero_has_its_strip() {
        let scale = Scale::over([0.1, 1.0, 1000.0].into_iter(), 0.0, 400.0);
        assert_eq!([0.1, 1.0, 1000.0].map(|v| scale.place(v).round()), [0.0, 100.0, 400.0]);
        let scale = Scale::over([0.0, 1.0, 10.0].into_iter(), 424.0, 0.0);
        assert_eq!([0.0, 1.0, 10.0].map(|v| scale.place(v).round()), [424.0, 400.0, 0.0]);
        let names: Vec<_> = scale.marks().into_iter().map(|mark| mark.1).collect();
        assert_eq!(names, ["0", "1", "2", "5", "10"]);
        assert_eq!((named(1e-4), named(1e5), named(0.01)), ("1e-4".into(), "1e5".into(), "0.01".into()));
    }

    #[test]
    fn a_picture_has_its_points_and_its_words() {
        let svg = chart(Better::Less, &[(1.0, 1.0), (10.0, 0.0), (10.0, 1.0)]).svg();
        assert_eq!(svg.matches("r=\"4.5\" fill=\"#88c0d0\" stroke").count(), 2, "two on the front");
        assert_eq!(svg.matches("r=\"3\" fill=\"none\"").count(), 1);
        assert!(svg.contains("<title>p1: 1 &lt; 1</title>") && svg.contains(">a &amp; b</text>"));
        assert_eq!(svg.matches(">p10</text>").count(), 1, "only points of the front are named");
        assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
    }
}
