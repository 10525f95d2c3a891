//! NMI and its forms against 60 digits.

use crate::bounds::exact::Real;
use crate::bounds::images::{self, TouchTaxels, moments};
use crate::bounds::table::bound;
use crate::plain::Plain;
use proptest::prelude::*;
use taxel_core::condition::{Image, Rows};
use taxel_core::contact::{Contact, ContactConfig, ContactState, Moments, Quartic};
use taxel_core::format::{Fixed24, Micros, Q15};
use taxel_core::garment::{Garment, Layout};
use taxel_core::shape::{Nmi, features, nmi};

const FORMS: usize = 5;

fn forms(nmi: &Nmi) -> [Fixed24; FORMS] {
    [nmi.published, nmi.peak, nmi.s2, nmi.peak_sheppard, nmi.s2_sheppard]
}

/// `sqrt(J) / m`, then times `sqrt(peak)` and `sqrt(sum f^2 / sum f)`, without and with `J - m / 6`.
fn exact(plain: &Plain) -> [Real; FORMS] {
    let Plain { m, s2, peak, .. } = *plain;
    let cube = m * m * m;
    // All under one root.
    let form = |jm: i128, factor: i128, over: i128| Real::ratio(jm.max(0) * factor, cube * over).sqrt();
    let (jm, six) = (plain.jm(), 6 * plain.jm() - m * m);
    let peak = i128::from(peak);
    [form(jm, 1, 1), form(jm, peak, 1), form(jm, s2, m), form(six, peak, 6), form(six, s2, 6 * m)]
}

#[test]
fn nmi_is_within_its_bound() {
    let stated = bound("NMI and its five forms", "nmi_is_within_its_bound");
    let (mut count, mut worst, mut share) = (0, 0f64, 0f64);
    for taxels in images::all() {
        let plain = Plain::of(&taxels);
        let have = nmi(&moments(&taxels), plain.peak);
        for (have, want) in forms(&have).into_iter().zip(exact(&plain)) {
            let value = want.to_f64();
            let error = (Real::ratio(have.0, 1 << 24) - want).abs().to_f64();
            assert!(error <= stated.at(value), "{} {value} {taxels:?}", have.to_f64());
            worst = worst.max(error);
            share = share.max(error / stated.at(value));
        }
        count += 1;
    }
    println!("{count} images, largest error {worst:.3e}, {:.1} % of the bound", 100.0 * share);
    assert!(count > 35_000);
}

/// The forms with a factor do not follow pressure: whole gains, so that the touch itself is not rounded anew.
#[test]
fn forms_are_immune_to_gain() {
    let stated = bound("NMI forms under gain", "forms_are_immune_to_gain");
    let (mut count, mut worst) = (0, 0f64);
    for taxels in images::all().step_by(3) {
        let peak = Plain::of(&taxels).peak;
        let at = |gain: u16| -> [Fixed24; FORMS] {
            let pressed: TouchTaxels = taxels.iter().map(|(x, y, f)| (*x, *y, f * gain)).collect();
            forms(&nmi(&moments(&pressed), peak * gain))
        };
        let base = at(1);
        for gain in [2, 3, 7, 16, 255, 4095, u16::MAX].into_iter().filter(|gain| *gain <= u16::MAX / peak) {
            // Sheppard's correction takes m / 6 off J, and both follow the gain alike.
            for (form, base) in at(gain).into_iter().zip(base).skip(1) {
                let (form, base) = (form.to_f64(), base.to_f64());
                worst = worst.max((form - base).abs());
                assert!((form - base).abs() <= stated.at(base), "{form} {base}, gain {gain}, {taxels:?}");
            }
            // As published, it falls with the root of the gain.
            let (published, before) = (at(gain)[0].to_f64(), base[0].to_f64());
            assert!((published * f64::from(gain).sqrt() - before).abs() <= stated.at(before) * 256.0);
            count += 1;
        }
    }
    println!("{count} pairs of images, largest difference {worst:.3e}");
    assert!(count > 20_000);
}

#[test]
fn outside_their_range_forms_are_none_or_saturate() {
    assert_eq!(nmi(&Moments::default(), 0), Nmi::default());
    // A single taxel has no extent, and less than the pixel itself is nothing.
    let one = nmi(&moments(&vec![(31, 63, 4095)]), 4095);
    assert_eq!(one, Nmi::default());
    // Two of 1 count 1,500 taxels apart: sqrt(J) / m = 1500 / sqrt(8) is beyond 256.
    let far = nmi(&moments(&vec![(0, 0, 1), (1500, 0, 1)]), 1);
    assert_eq!(forms(&far), [Fixed24(u32::MAX); FORMS]);
    // The peak is taken as it is reported: 0 makes the form 0.
    let pair = moments(&vec![(0, 0, 5), (9, 0, 5)]);
    assert_eq!((nmi(&pair, 0).peak, nmi(&pair, 0).peak_sheppard), (Fixed24(0), Fixed24(0)));
    assert!(nmi(&pair, 0).published.0 > 0);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    /// Whatever the numbers are, sums that wrapped too: these tests are built with checks of overflow.
    #[test]
    fn nmi_is_total(bits in 0..64u32, m: u64, sx: i64, sy: i64, sums: [u64; 3], sxy: i64, peak: u16) {
        let [sxx, syy, s2] = sums;
        let any = Moments { m: m >> bits, sx, sy, sxx, syy, sxy, s2 };
        let forms = nmi(&any, peak);
        prop_assert!(any.m > 0 || forms == Nmi::default());
        prop_assert!(peak > 0 || forms.peak == Fixed24(0));
    }
}

/// Any contact.
pub fn contact() -> Contact {
    let layout = Layout::build(&Garment::recorded(1, 1), 1, u16::MAX).unwrap();
    let mut state: ContactState<1, 1> = ContactState::new();
    let image = Image { values: &[500], rows: &Rows::ALL };
    let stage = ContactConfig::default().build().unwrap();
    stage.process(&mut state, &layout, &image, Micros(0)).present[0].clone()
}

/// What goes to the nearest neighbours is held within 16 bits.
#[test]
fn features_outside_their_range_saturate() {
    let mut any = contact();
    let quartic = Quartic { kurtosis: i16::MAX, two: 0, four: 7 };
    let ends = |nmi: Fixed24, anisotropy: i32, area: u16, contact: &mut Contact| {
        (contact.anisotropy, contact.area) = (Q15(anisotropy), area);
        features(&Nmi { s2_sheppard: nmi, ..Nmi::default() }, &quartic, contact)
    };
    let [most, least] = [i16::MAX, 0];
    assert_eq!(ends(Fixed24(0), -5, 0, &mut any), [0, 0, 0, most, least, 7]);
    assert_eq!(ends(Fixed24(u32::MAX), i32::MAX, u16::MAX, &mut any), [32767, 512, 1023, most, least, 7]);
    // Just below 16, nothing is lost but what is cut.
    assert_eq!(ends(Fixed24((16 << 24) - 1), 32768, 2048, &mut any), [32767, 512, 704, most, least, 7]);
    assert_eq!(ends(Fixed24(4 << 24), 16384, 3, &mut any), [8192, 256, 96, most, least, 7]);
}
