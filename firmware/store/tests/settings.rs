//! Settings in flash: what was stored is loaded again, even if the power fails at any step of a save.

#[allow(dead_code)] // a part of it is for the other tests
#[path = "../../../host/sim/src/flash.rs"]
mod flash;

use embedded_storage::nor_flash::{ErrorType, NorFlash, ReadNorFlash};
use fastrand::Rng;
use flash::{Cut, FlashError, SimFlash};
use taxel_core::acquire::ScanError;
use taxel_core::board::{Board, BoardInfo, Input, Job, PART_BYTES, Part, Saved, Settings};
use taxel_core::condition::Certificate;
use taxel_core::format::{Micros, name};
use taxel_core::garment::{Garment, Pins};
use taxel_core::react::Levels;
use taxel_core::scene::Scene;
use taxel_core::wire::{Request, encode};
use taxel_store::{CHUNK, Found, Store, StoreError, in_force, keep_levels};

/// Settings that a host may make.
#[derive(Debug, Clone, PartialEq)]
struct HostSettings {
    garment: Garment,
    scene: Scene,
    gain: Vec<u16>,
    baseline: Option<Vec<u16>>,
    calibration: Option<Certificate>,
}

/// Number of saves left, in every save of these tests.
const SAVES: u8 = 7;

impl HostSettings {
    fn new(garment: Garment, taxels: usize) -> HostSettings {
        HostSettings {
            garment,
            scene: Scene::shipped(),
            gain: vec![4096; taxels],
            baseline: None,
            calibration: None,
        }
    }

    fn settings(&self) -> Settings<'_> {
        Settings {
            garment: &self.garment,
            scene: &self.scene,
            gain: &self.gain,
            faulty: &[],
            baseline: self.baseline.as_deref(),
            calibration: self.calibration.as_ref(),
            saves: SAVES,
        }
    }

    /// Changes one to four of the parts.
    fn change(&mut self, random: &mut Rng) {
        let parts = 1 + random.u32(..15);
        if parts & 1 != 0 {
            self.garment.wiring.settle_ns = 1_000 + random.u32(..100_000);
            self.garment.name = name(&"longer and longer"[..1 + random.usize(..15)]);
        }
        if parts & 2 != 0 {
            self.scene.contact.high = 20 + random.u16(..1_000);
            self.scene.joints.truncate(random.usize(..3));
        }
        if parts & 4 != 0 {
            self.gain.iter_mut().for_each(|gain| *gain = random.u16(..));
            let (id, taxels) = (random.u32(..1 << 24), self.gain.len() as u16);
            self.calibration = Some(Certificate { id, taxels, year: 2026, month: 11, day: 21, error: 99 })
                .filter(|_| random.u32(..4) > 0);
        }
        if parts & 8 != 0 {
            let codes = self.gain.iter().map(|_| random.u16(..4_096)).collect();
            // Without a baseline before and after, nothing would change.
            self.baseline = Some(codes).filter(|_| self.baseline.is_none() || random.u32(..8) > 0);
        }
    }
}

/// A flash of twice the size that the block needs: every sector is erased again and again.
const FOUR_SECTORS: u32 = 16 * 1024;

/// Sectors reserved for that many taxels.
fn range(taxels: usize) -> std::ops::Range<u32> {
    0..if taxels == 64 { FOUR_SECTORS } else { SimFlash::BYTES }
}

fn save(flash: &mut SimFlash, kept: &HostSettings) -> Result<Saved, StoreError> {
    Store::new(flash, range(kept.gain.len())).unwrap().save(&kept.settings())
}

/// Settings of a board after start-up; none if the flash holds nothing.
fn load<const TAXELS: usize>(flash: &mut SimFlash) -> Result<Option<HostSettings>, StoreError> {
    load_from::<TAXELS>(flash, range(TAXELS))
}

fn load_from<const TAXELS: usize>(
    flash: &mut SimFlash,
    range: std::ops::Range<u32>,
) -> Result<Option<HostSettings>, StoreError> {
    let info =
        BoardInfo { firmware: "", chip: "", pins: Pins::ANY, full_scale: 4095, link_bytes_per_s: 1_000_000 };
    let mut board = Box::new(Board::<TAXELS, 32>::new(info, Garment::block(), Scene::shipped()).unwrap());
    let found = Store::new(flash, range).unwrap().load(&mut board)?;
    let Settings { garment, scene, gain, baseline, calibration, .. } = board.settings();
    Ok((found == Found::Settings).then(|| HostSettings {
        garment: garment.clone(),
        scene: scene.clone(),
        gain: gain.to_vec(),
        baseline: baseline.map(<[u16]>::to_vec),
        calibration: calibration.copied(),
    }))
}

#[test]
fn power_may_fail_at_any_step_of_200_changes() {
    let mut random = Rng::with_seed(1);
    let mut flash = SimFlash::default();
    let mut kept = HostSettings::new(Garment::block(), 64);
    let mut old = None;
    let mut cuts = 0;
    for change in 0..200 {
        kept.change(&mut random);
        let before = flash.clone();
        assert_eq!(save(&mut flash, &kept), Ok(Saved::Written), "change {change}");
        for step in before.steps()..flash.steps() {
            for cut in [Cut::Before, Cut::Within, Cut::After] {
                let mut torn = before.clone();
                torn.cut_at(step, cut);
                assert_eq!(save(&mut torn, &kept), Err(StoreError::Flash));
                torn.restore_power();
                let found = load::<64>(&mut torn).unwrap();
                assert!(
                    found == old || found.as_ref() == Some(&kept),
                    "change {change}, step {step}, {cut:?}"
                );
                save(&mut torn, &kept).unwrap();
                assert_eq!(load::<64>(&mut torn).unwrap().as_ref(), Some(&kept));
                cuts += 1;
            }
        }
        old = load::<64>(&mut flash).unwrap();
        assert_eq!(old.as_ref(), Some(&kept));
    }
    println!("{cuts} cuts in {} writes and erasures, {} of these", flash.steps(), flash.erased());
    assert!(flash.erased() >= 16, "every sector was erased several times");
}

#[test]
fn the_greatest_garment_fits_however_often_it_is_saved() {
    let mut random = Rng::with_seed(2);
    let mut flash = SimFlash::default();
    let mut kept = HostSettings::new(Garment::reference(), 2048);
    for _ in 0..60 {
        kept.garment.wiring.settle_ns = 1_000 + random.u32(..1_000);
        kept.scene.contact.high = 20 + random.u16(..1_000);
        kept.gain.iter_mut().for_each(|gain| *gain = random.u16(..));
        kept.baseline = Some(kept.gain.iter().map(|_| random.u16(..4_096)).collect());
        assert_eq!(save(&mut flash, &kept), Ok(Saved::Written));
        assert_eq!(load::<2048>(&mut flash).unwrap().as_ref(), Some(&kept));
    }
    println!("{:.1} sectors erased a save", flash.erased() as f64 / 60.0);
    assert!(flash.erased() <= 60 * 6);
}

#[test]
fn what_has_not_changed_is_not_written() {
    let mut flash = SimFlash::default();
    let mut kept = HostSettings::new(Garment::block(), 64);
    assert_eq!(save(&mut flash, &kept), Ok(Saved::Written));
    assert_eq!(flash.erased(), 0, "blank sectors need no erasure");
    let steps = flash.steps();
    assert_eq!(save(&mut flash, &kept), Ok(Saved::Unchanged));
    assert_eq!(flash.steps(), steps);
    kept.gain[5] = 0;
    assert_eq!(save(&mut flash, &kept), Ok(Saved::Written));
    assert!(flash.steps() - steps <= 12, "only the gains and the index: {}", flash.steps() - steps);
}

#[test]
fn an_empty_or_alien_flash_is_said_to_be_so() {
    use embedded_storage::nor_flash::NorFlash;
    let mut flash = SimFlash::default();
    assert_eq!(load::<64>(&mut flash), Ok(None));
    let mut random = Rng::with_seed(3);
    let noise: Vec<u8> = (0..SimFlash::BYTES).map(|_| random.u8(..)).collect();
    flash.write(0, &noise).unwrap();
    assert!(matches!(load::<64>(&mut flash), Ok(None) | Err(StoreError::Damaged)));
    let kept = HostSettings::new(Garment::block(), 64);
    save(&mut flash, &kept).unwrap();
    assert_eq!(load::<64>(&mut flash).unwrap(), Some(kept));
    let short = Store::new(&mut flash, 0..4096).err();
    assert_eq!(short, Some(StoreError::Range));
}

#[test]
fn a_part_that_does_not_fit_leaves_the_others() {
    let mut flash = SimFlash::default();
    // A board of 64 taxels loads settings stored by one of 2,048.
    let calibration = Some(Certificate { id: 7, taxels: 2048, year: 2026, month: 11, day: 21, error: 99 });
    let kept =
        HostSettings { gain: vec![1; 2048], calibration, ..HostSettings::new(Garment::reference(), 2048) };
    save(&mut flash, &kept).unwrap();
    let found = load_from::<64>(&mut flash, range(2048)).unwrap().unwrap();
    assert_eq!((found.garment, found.gain, found.calibration), (Garment::block(), vec![4096; 64], None));
    let mut buffer = [0; 4000];
    assert!(kept.settings().write(Part::Gain, &mut buffer).is_err());
}

/// Result of loading, garment of the board after it, and number of saves left.
fn start(flash: &mut SimFlash) -> (Found, Garment, usize) {
    let info =
        BoardInfo { firmware: "", chip: "", pins: Pins::ANY, full_scale: 4095, link_bytes_per_s: 1_000_000 };
    let mut board = Box::new(Board::<64, 32>::new(info, Garment::block(), Scene::shipped()).unwrap());
    let found = Store::new(flash, range(64)).unwrap().load(&mut board).unwrap();
    let garment = board.settings().garment.clone();
    let mut wire = [0; 64];
    let save = encode(&Request::Save, &mut wire).unwrap();
    // All within seconds: no further save is granted.
    let (mut saves, mut now) = (0, Micros(1_000));
    while saves < 99 {
        board.step(now, Input::Received(save), &mut ());
        let asked = (0..9).any(|_| {
            now.0 += 50_000;
            let job = board.step(now, Input::Tick, &mut ());
            if let Some(Job::Scan(_)) = job {
                board.step(now, Input::Scanned(Err(ScanError::Conversion)), &mut ());
            }
            job == Some(Job::Save)
        });
        if !asked {
            break;
        }
        board.step(now, Input::Saved(Ok(Saved::Written)), &mut ());
        saves += 1;
    }
    (found, garment, saves)
}

#[test]
fn what_is_put_aside_is_kept_until_it_is_taken_up_or_replaced() {
    let mut flash = SimFlash::default();
    let aside = |flash: &mut SimFlash, aside| Store::new(flash, range(64)).unwrap().put_aside(aside);
    assert_eq!(aside(&mut flash, true), Ok(Saved::Unchanged), "there is nothing to be put aside");
    let garment = Garment { name: name("stored"), ..Garment::block() };
    let kept = HostSettings::new(garment.clone(), 64);
    save(&mut flash, &kept).unwrap();
    assert_eq!(start(&mut flash), (Found::Settings, garment.clone(), SAVES.into()));
    assert_eq!([true, true].map(|it| aside(&mut flash, it)), [Ok(Saved::Written), Ok(Saved::Unchanged)]);
    assert_eq!(start(&mut flash), (Found::Aside, Garment::block(), SAVES.into()), "the quota stays");
    assert_eq!(aside(&mut flash, false), Ok(Saved::Written));
    assert_eq!(start(&mut flash).1, garment);
    aside(&mut flash, true).unwrap();
    assert_eq!(save(&mut flash, &kept), Ok(Saved::Written), "the same again, but in force");
    assert_eq!(start(&mut flash).1, garment);
}

#[test]
fn power_may_fail_while_settings_are_put_aside() {
    let mut flash = SimFlash::default();
    let garment = Garment { name: name("stored"), ..Garment::block() };
    save(&mut flash, &HostSettings::new(garment.clone(), 64)).unwrap();
    for round in 0..40 {
        let (before, old) = (flash.clone(), start(&mut flash));
        Store::new(&mut flash, range(64)).unwrap().put_aside(round % 2 == 0).unwrap();
        let new = start(&mut flash);
        assert_ne!(old, new);
        for step in before.steps()..flash.steps() {
            for cut in [Cut::Before, Cut::Within, Cut::After] {
                let mut torn = before.clone();
                torn.cut_at(step, cut);
                let end = Store::new(&mut torn, range(64)).unwrap().put_aside(round % 2 == 0);
                assert_eq!(end, Err(StoreError::Flash));
                torn.restore_power();
                let found = start(&mut torn);
                assert!(found == old || found == new, "round {round}, step {step}, {cut:?}: {found:?}");
            }
        }
    }
}

#[test]
fn a_flash_that_cannot_be_read_is_said_to_be_so() {
    let mut flash = SimFlash::default();
    let kept = HostSettings::new(Garment::block(), 64);
    save(&mut flash, &kept).unwrap();
    flash.cut_at(flash.steps(), Cut::Before);
    assert!(flash.write(0, &[0]).is_err(), "the power is off from here on");
    for aside in [true, false] {
        assert_eq!(Store::new(&mut flash, range(64)).unwrap().put_aside(aside), Err(StoreError::Flash));
    }
    assert_eq!(save(&mut flash, &kept), Err(StoreError::Flash));
    assert_eq!(load::<64>(&mut flash), Err(StoreError::Flash));
}

/// The sectors with the levels of outputs.
const LEVELS: [u32; 2] = [0, 4096];

/// Levels with which a board would start.
fn levels(flash: &mut SimFlash) -> Levels {
    let records = LEVELS.map(|start| {
        let mut bytes = [0; 16];
        flash.read(start, &mut bytes).unwrap();
        let (words, _) = bytes.as_chunks();
        std::array::from_fn(|at| u32::from_le_bytes(words[at]))
    });
    in_force(records).unwrap_or_default()
}

#[test]
fn power_may_fail_while_levels_are_kept() {
    let (mut flash, mut random) = (SimFlash::default(), Rng::with_seed(5));
    assert_eq!(keep_levels(&mut flash, LEVELS, Levels::default()), Ok(Saved::Unchanged), "none are needed");
    assert_eq!(flash.steps(), 0);
    for round in 0..60 {
        let pins = 1 + random.u32(..1 << 20);
        let wanted = Levels { pins, high: pins & random.u32(..1 << 20) };
        let (before, old) = (flash.clone(), levels(&mut flash));
        keep_levels(&mut flash, LEVELS, wanted).unwrap();
        assert_eq!(levels(&mut flash), wanted);
        for step in before.steps()..flash.steps() {
            for cut in [Cut::Before, Cut::Within, Cut::After] {
                let mut torn = before.clone();
                torn.cut_at(step, cut);
                assert_eq!(keep_levels(&mut torn, LEVELS, wanted), Err(StoreError::Flash));
                torn.restore_power();
                let found = levels(&mut torn);
                assert!(found == old || found == wanted, "round {round}, step {step}, {cut:?}: {found:?}");
                // The next attempt is certain to store it.
                keep_levels(&mut torn, LEVELS, wanted).unwrap();
                assert_eq!(levels(&mut torn), wanted);
            }
        }
        let steps = flash.steps();
        assert_eq!(keep_levels(&mut flash, LEVELS, wanted), Ok(Saved::Unchanged));
        assert_eq!(flash.steps(), steps);
    }
}

/// Contents left by boot loaders, other firmware and half an erasure: a flash need not be blank at first use.
#[test]
fn a_flash_that_something_else_has_written_takes_settings() {
    let mut random = Rng::with_seed(19);
    for round in 0..200 {
        let mut flash = SimFlash::default();
        for _ in 0..1 + random.u32(..9) {
            let place = random.u32(..FOUR_SECTORS - 600);
            let bytes: Vec<u8> = (0..random.u32(..600)).map(|_| random.u8(..)).collect();
            // Bits that would have to rise stay 0.
            let _ = flash.write(place, &bytes);
        }
        let mut kept = HostSettings::new(Garment::block(), 64);
        (0..3).for_each(|_| kept.change(&mut random));
        assert_eq!(save(&mut flash, &kept), Ok(Saved::Written), "round {round}");
        assert_eq!(load::<64>(&mut flash), Ok(Some(kept)), "round {round}");
    }
}

#[test]
fn settings_that_do_not_fit_are_refused_and_leave_the_old_ones() {
    let small = HostSettings::new(Garment::block(), 64);
    let large =
        HostSettings { baseline: Some(vec![9; 2048]), ..HostSettings::new(Garment::reference(), 2048) };
    // At least four items in each sector but one; the index is one.
    let mut buffer = [0; PART_BYTES];
    let lengths =
        Part::ALL.map(|part| large.settings().write(part, &mut buffer).unwrap().map_or(0, <[u8]>::len));
    let items = 1 + lengths.iter().map(|length| length.div_ceil(CHUNK)).sum::<usize>();
    let mut full = 0;
    for sectors in 2..16u32 {
        let (mut flash, range) = (SimFlash::default(), 0..4096 * sectors);
        let save = |flash: &mut SimFlash, kept: &HostSettings| {
            Store::new(flash, range.clone()).unwrap().save(&kept.settings())
        };
        assert_eq!(save(&mut flash, &small), Ok(Saved::Written));
        let end = save(&mut flash, &large);
        let taken = end == Ok(Saved::Written);
        // Shorter items leave room for more of them.
        let refused = end == Err(StoreError::Full) && items > 4 * (sectors as usize - 1);
        assert!(taken || refused, "{end:?}: {items} items, {sectors} sectors");
        let found = load_from::<2048>(&mut flash, range.clone()).unwrap().unwrap();
        assert_eq!(found.garment, if taken { &large } else { &small }.garment, "{sectors} sectors");
        full += u32::from(refused);
        // Sectors that hold the settings once need not hold the old and the new ones together.
        let other = HostSettings { gain: vec![5; 2048], baseline: Some(vec![8; 2048]), ..large.clone() };
        if items <= 4 * (sectors as usize - 1) {
            assert_eq!(save(&mut flash, &other), Ok(Saved::Written), "{sectors} sectors");
            assert_eq!(load_from::<2048>(&mut flash, range.clone()), Ok(Some(other)), "{sectors} sectors");
        }
    }
    assert_eq!(full, 2);
}

#[test]
fn what_is_damaged_is_written_again() {
    let mut flash = SimFlash::default();
    let kept = HostSettings { baseline: Some(vec![0x123; 64]), ..HostSettings::new(Garment::block(), 64) };
    save(&mut flash, &kept).unwrap();
    let mut held = vec![0; FOUR_SECTORS as usize];
    flash.read(0, &mut held).unwrap();
    let (mut unread, mut places) = (0, 0);
    for place in (0..held.len()).filter(|place| ![0, 0xff].contains(&held[*place])) {
        let mut damaged = flash.clone();
        damaged.write(place as u32, &[0]).unwrap();
        let read = load::<64>(&mut damaged);
        unread += u32::from(read.is_err());
        assert!(matches!(read, Ok(None) | Err(_)) || read == Ok(Some(kept.clone())), "byte {place}");
        save(&mut damaged, &kept).unwrap();
        assert_eq!(load::<64>(&mut damaged).unwrap().as_ref(), Some(&kept), "byte {place}");
        places += 1;
    }
    assert!(places > 300 && unread > places / 2, "{unread} of {places}");
}

/// A flash that reports no error for bits that it cannot raise, as the chips do.
struct Silent(SimFlash);

impl ErrorType for Silent {
    type Error = FlashError;
}

impl ReadNorFlash for Silent {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), FlashError> {
        self.0.read(offset, bytes)
    }

    fn capacity(&self) -> usize {
        self.0.capacity()
    }
}

impl NorFlash for Silent {
    const WRITE_SIZE: usize = 1;
    const ERASE_SIZE: usize = SimFlash::ERASE_SIZE;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), FlashError> {
        self.0.erase(from, to)
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), FlashError> {
        let mut held = vec![0; bytes.len()];
        self.0.read(offset, &mut held)?;
        held.iter_mut().zip(bytes).for_each(|(held, byte)| *held &= byte);
        self.0.write(offset, &held)
    }
}

#[test]
fn what_a_flash_did_not_take_is_noticed() {
    let mut random = Rng::with_seed(23);
    let mut kept = HostSettings::new(Garment::block(), 64);
    for round in 0..300 {
        let mut flash = Silent(SimFlash::default());
        let range = 0..FOUR_SECTORS;
        Store::new(&mut flash, range.clone()).unwrap().save(&kept.settings()).unwrap();
        // Bits are lost where the next items will lie.
        for _ in 0..1 + random.u32(..4) {
            let place = random.u32(..4096);
            flash.write(place, &[random.u8(..)]).unwrap();
        }
        kept.change(&mut random);
        Store::new(&mut flash, range).unwrap().save(&kept.settings()).unwrap();
        assert_eq!(load::<64>(&mut flash.0), Ok(Some(kept.clone())), "round {round}");
    }
}
