//! All contacts of a scene on a garment: force on a taxel at a time.

use super::contact::Contact;
use super::error::ScriptError;
use super::footprint::{Footprint, is_too_fine};
use super::script::Script;
use super::touch::{Shape, Touch};
use super::trace::{Knot, Trace};
use std::sync::Arc;
use taxel_core::garment::{Area, Layout, Transform};

/// Pitch of a garment without one, mm.
const USUAL_PITCH_MM: f64 = 10.0;
/// Most images of one contact; a garment has eight panels, and a contact goes around the body less than once.
const MOST_IMAGES: usize = 64;

/// The contacts of a scene, sorted by the panels that they reach.
#[derive(Debug, Clone)]
pub struct Pressure {
    layout: Arc<Layout>,
    hysteresis: f64,
    panels: Vec<Vec<Image>>,
}

/// A contact as seen from one panel: its position continues across a seam, so the panel's taxels are looked
/// up in the coordinates of the panel on which the contact began.
#[derive(Debug, Clone)]
struct Image {
    rank: Rank,
    first_ns: u64,
    last_ns: u64,
    /// Taxels of this panel within reach, ends included: `[x_min, x_max, y_min, y_max]`.
    sweep: [i32; 4],
    to_home: Transform,
    contact: Arc<Contact>,
}

/// Order in which forces are added, that of a script's file, so that a drawn touch gives the same sums while it
/// is drawn and when it is played.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Rank {
    Touch(u64),
    Trace(u64),
}

impl Pressure {
    /// Contacts of a valid script on a garment.
    pub fn build(script: &Script, layout: &Layout) -> Result<Pressure, ScriptError> {
        let panels = vec![Vec::new(); layout.areas().len()];
        let mut pressure =
            Pressure { layout: Arc::new(layout.clone()), hysteresis: script.sensor.hysteresis, panels };
        for (index, touch) in script.touches.iter().enumerate() {
            let place = || format!("in script {}: touch {}", script.name, index + 1);
            pressure.touch(index as u64, touch).map_err(|error| error.inside(place()))?;
        }
        for (index, trace) in script.traces.iter().enumerate() {
            let place = || format!("in script {}: trace {}", script.name, index + 1);
            pressure.trace(index as u64, trace, false).map_err(|error| error.inside(place()))?;
        }
        Ok(pressure)
    }

    /// Adds a touch. Numbers ascend.
    pub fn touch(&mut self, number: u64, touch: &Touch) -> Result<(), ScriptError> {
        let (home, pitch) = self.home(&touch.panel, touch.shape, touch.size(), touch.angle_deg)?;
        let contact = Contact::build(touch, pitch, self.hysteresis);
        self.add(Rank::Touch(number), Arc::new(contact), home);
        Ok(())
    }

    /// Adds a touch along a path, whose last place and force stay if it `lasts`. Numbers ascend.
    pub fn trace(&mut self, number: u64, trace: &Trace, lasts: bool) -> Result<(), ScriptError> {
        let (home, pitch) = self.home(&trace.panel, trace.shape, trace.size(), trace.angle_deg)?;
        let footprint = Footprint::build(trace.shape, trace.size(), trace.angle_deg, pitch);
        let contact = Contact::drawn(Arc::new(footprint), trace.knots(), lasts);
        self.add(Rank::Trace(number), Arc::new(contact), home);
        Ok(())
    }

    /// Replaces the path of a touch that lasts.
    pub fn draw(&mut self, number: u64, path: Vec<Knot>, lasts: bool) {
        let rank = Rank::Trace(number);
        let own = |image: &&Image| image.rank == rank && image.to_home == Transform::IDENTITY;
        let mut all = self.panels.iter().enumerate();
        let found =
            all.find_map(|(home, images)| Some((home, images.iter().find(own)?.contact.footprint.clone())));
        let Some((home, footprint)) = found else { return };
        self.panels.iter_mut().for_each(|images| images.retain(|image| image.rank != rank));
        self.add(rank, Arc::new(Contact::drawn(footprint, path, lasts)), home);
    }

    /// Forgets what has ended by a time.
    pub fn forget(&mut self, t_ns: u64) {
        self.panels.iter_mut().for_each(|images| images.retain(|image| image.last_ns > t_ns));
    }

    /// Index and pitch (mm) of the panel of an object.
    fn home(
        &self,
        panel: &str,
        shape: Shape,
        size_mm: [f64; 2],
        angle_deg: f64,
    ) -> Result<(usize, [f64; 2]), ScriptError> {
        let areas = self.layout.areas();
        let Some((home, area)) = areas.iter().enumerate().find(|(_, area)| area.name == panel) else {
            let names: Vec<_> = areas.iter().map(|a| a.name.as_str()).collect();
            let text = format!("`panel` is \"{panel}\", the garment has {}", names.join(", "));
            return Err(ScriptError::value("panel", text));
        };
        let pitch = pitch_mm(area);
        let ([length, width], [x, y]) = (size_mm, pitch);
        if is_too_fine(shape, size_mm, angle_deg, pitch) {
            let text = format!("`size_mm` is {length} x {width} mm, too large for taxels of {x} x {y} mm");
            return Err(ScriptError::value("size_mm", text));
        }
        Ok((home, pitch))
    }

    /// Adds the images of a contact on its panel and across seams, as far as it reaches.
    fn add(&mut self, rank: Rank, contact: Arc<Contact>, home: usize) {
        let (layout, panels) = (&self.layout, &mut self.panels);
        let (first_ns, last_ns) = contact.span_ns();
        let mut seen = vec![(home, Transform::IDENTITY)];
        let mut next = 0;
        while let Some((panel, to_home)) = seen.get(next).copied() {
            next += 1;
            let Some(area) = layout.areas().get(panel) else { continue };
            let Some(sweep) = sweep_on(area, &contact.sweep(), &to_home) else { continue };
            if let Some(images) = panels.get_mut(panel) {
                let at = images.partition_point(|image| image.rank <= rank);
                images
                    .insert(at, Image { rank, first_ns, last_ns, sweep, to_home, contact: contact.clone() });
            }
            for joint in layout.joints() {
                let (a, b) = (usize::from(joint.a), usize::from(joint.b));
                for (here, there, there_to_here) in [(a, b, joint.b_to_a), (b, a, joint.b_to_a.inverse())] {
                    let image = (there, to_home.after(&there_to_here));
                    if here == panel && !seen.contains(&image) && seen.len() < MOST_IMAGES {
                        seen.push(image);
                    }
                }
            }
        }
    }

    /// Felt force on the taxel at column `x`, row `y` of a panel at a time, N; 0 outside the garment.
    #[inline]
    pub fn newtons(&self, panel: usize, x: i32, y: i32, t_ns: u64) -> f32 {
        let Some(images) = self.panels.get(panel) else { return 0.0 };
        let mut sum = 0.0;
        for image in images {
            let [left, right, top, bottom] = image.sweep;
            let near = x >= left && x <= right && y >= top && y <= bottom;
            if near && t_ns >= image.first_ns && t_ns < image.last_ns {
                let (x, y) = image.to_home.apply(i64::from(x), i64::from(y), 1);
                sum += image.contact.newtons(x as f32, y as f32, t_ns);
            }
        }
        sum
    }
}

/// Distance of taxel centres along x and y, mm.
pub(super) fn pitch_mm(area: &Area) -> [f64; 2] {
    area.pitch_um.map(|um| if um == 0 { USUAL_PITCH_MM } else { f64::from(um) / 1000.0 })
}

/// Part of a panel covered by a box in home coordinates; none if it misses the panel.
fn sweep_on(area: &Area, home: &[f64; 4], to_home: &Transform) -> Option<[i32; 4]> {
    let [left, right, top, bottom] = *home;
    // A whole taxel wider, so that rounding to integers loses nothing.
    let (x0, y0) = (left.floor() as i64 - 1, top.floor() as i64 - 1);
    let (x1, y1) = (right.ceil() as i64 + 1, bottom.ceil() as i64 + 1);
    let here = to_home.inverse();
    let (ax, ay) = here.apply(x0, y0, 1);
    let (bx, by) = here.apply(x1, y1, 1);
    let clip = |a: i64, b: i64, count: u16| {
        let (low, high) = (a.min(b).max(0), a.max(b).min(i64::from(count) - 1));
        (low <= high).then_some((low as i32, high as i32))
    };
    let ((left, right), (top, bottom)) = (clip(ax, bx, area.columns)?, clip(ay, by, area.rows)?);
    Some([left, right, top, bottom])
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::garment::Garment;

    fn layout() -> Layout {
        Layout::build(&Garment::reference(), 2048, 4095).unwrap()
    }

    fn script(touch: &str) -> Script {
        let text = format!(
            "name = \"test\"\nduration_s = 9\n[[touch]]\nstart_s = 0\nrise_s = 0\nhold_s = 4\nfall_s = 0\nforce_n = 10\n{touch}"
        );
        text.parse::<Script>().unwrap()
    }

    /// Force and centre by panel: `[N, x, y]`.
    fn totals(pressure: &Pressure, layout: &Layout, t_ns: u64) -> Vec<[f64; 3]> {
        let areas = layout.areas().iter().enumerate();
        let total = |(panel, area): (usize, &Area)| {
            let mut sums = [0.0; 3];
            for (y, x) in
                (0..i32::from(area.rows)).flat_map(|y| (0..i32::from(area.columns)).map(move |x| (y, x)))
            {
                let f = f64::from(pressure.newtons(panel, x, y, t_ns));
                sums = [sums[0] + f, sums[1] + f * f64::from(x), sums[2] + f * f64::from(y)];
            }
            if sums[0] > 0.0 { [sums[0], sums[1] / sums[0], sums[2] / sums[0]] } else { sums }
        };
        areas.map(total).collect()
    }

    #[test]
    fn a_contact_well_inside_gives_its_force() {
        let layout = layout();
        let pressure =
            Pressure::build(&script("panel = \"back\"\nshape = \"palm\"\nat_mm = [90, 155]"), &layout)
                .unwrap();
        let now = totals(&pressure, &layout, 1_000_000_000);
        assert!(
            (now[1][0] - 10.0).abs() < 1e-3
                && (now[1][1] - 7.5).abs() < 1e-3
                && (now[1][2] - 15.5).abs() < 1e-3
        );
        assert_eq!([now[0][0], now[2][0], now[3][0]], [0.0; 3]);
        assert_eq!(totals(&pressure, &layout, 4_000_000_000)[1][0], 0.0);
    }

    #[test]
    fn a_moving_contact_crosses_the_flank_and_loses_nothing() {
        let layout = layout();
        // From the chest over its right side (x = 15) to the back, whose left side (x = 0) is sewn there.
        let text = "panel = \"chest\"\nshape = \"ball\"\nat = [10, 16]\nvelocity = [4, 0]";
        let pressure = Pressure::build(&script(text), &layout).unwrap();
        for tenth in 0..40 {
            let now = totals(&pressure, &layout, tenth * 100_000_000);
            assert!((now[0][0] + now[1][0] - 10.0).abs() < 1e-3, "at {tenth}: {now:?}");
        }
        let end = totals(&pressure, &layout, 3_900_000_000);
        assert!((end[1][1] - 9.6).abs() < 0.05 && end[1][0] > 9.99, "{end:?}");
        // It continues over the other flank, back to the chest.
        let text = "panel = \"chest\"\nshape = \"ball\"\nat = [8, 16]\nvelocity = [10, 0]";
        let pressure = Pressure::build(&script(text), &layout).unwrap();
        let end = totals(&pressure, &layout, 3_200_000_000);
        assert!((end[0][1] - 8.0).abs() < 0.05 && end[0][0] > 9.99, "{end:?}");
    }

    #[test]
    fn a_footprint_of_too_many_taxels_is_refused() {
        let mut garment = Garment::reference();
        garment.panels[1].pitch_um = [500, 500];
        let layout = Layout::build(&garment, 2048, 4095).unwrap();
        let of = |size: &str| {
            let text = format!("panel = \"back\"\nshape = \"box\"\nat = [1, 1]\nsize_mm = {size}");
            Pressure::build(&script(&text), &layout)
        };
        assert!(of("100").is_ok());
        let why = of("[1000, 900]").unwrap_err().to_string();
        let said =
            "in script test: touch 1: `size_mm` is 1000 x 900 mm, too large for taxels of 0.5 x 0.5 mm";
        assert_eq!(why, said);
    }

    #[test]
    fn an_unknown_panel_is_named() {
        let error = Pressure::build(&script("panel = \"leg\"\nshape = \"palm\"\nat = [1, 1]"), &layout())
            .unwrap_err();
        assert_eq!(
            error.to_string(),
            "in script test: touch 1: `panel` is \"leg\", the garment has chest, back, left arm, right arm"
        );
    }
}
