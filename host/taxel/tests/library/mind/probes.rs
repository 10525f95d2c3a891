//! Active touch: what a limb meets is soft, hard, sharp or moving, and is held, explored or avoided.
//!
//! `TAXEL_CAMPAIGN=1`: 400 probes of objects on which the map was not tuned, instead of 32.

use super::probed::{Found, Object, Thing, other, probe, prober, tuned};
use fastrand::Rng;
use taxel::fcm::board::BoardMap;
use taxel::fcm::decimal::Decimal;

/// Counts of what was found, by object: right, and followed by the right response.
fn table(make: fn(Object, &mut Rng) -> Thing, seeds: std::ops::Range<u64>) -> [usize; 3] {
    let (robot, mut sums) = (prober(), [0; 3]);
    println!("{:8} {:>5} {:>6} {:>9}  taken for", "object", "count", "right", "response");
    for object in Object::ALL {
        let [is, does] = object.names();
        let (mut right, mut follows, mut taken) = (0, 0, std::collections::BTreeMap::<String, usize>::new());
        let mut wrong = Vec::new();
        for seed in seeds.clone() {
            let mut rng = Rng::with_seed(seed * 7 + object as u64);
            let thing = make(object, &mut rng);
            let Found { holding, note } = probe(&robot, &thing, &mut rng);
            let kinds: Vec<&str> = Object::ALL.iter().map(|object| object.names()[0]).collect();
            let said: Vec<&str> =
                kinds.into_iter().filter(|kind| holding.iter().any(|it| it == kind)).collect();
            let responses = ["hold", "explore", "avoid"];
            let done: Vec<&str> =
                responses.into_iter().filter(|it| holding.iter().any(|held| held == it)).collect();
            right += usize::from(said == [is]);
            follows += usize::from(said == [is] && done == [does]);
            *taken.entry(said.join("+")).or_default() += 1;
            if said != [is] {
                wrong.push(format!("  {object:?} {seed}: {holding:?}: {note}"));
            }
        }
        let count = seeds.clone().count();
        println!("{:8} {count:>5} {right:>6} {follows:>9}  {taken:?}", is);
        wrong.iter().for_each(|line| println!("{line}"));
        sums.iter_mut().zip([count, right, follows]).for_each(|(sum, one)| *sum += one);
    }
    sums
}

#[test]
fn what_a_limb_meets_is_reported_and_answered() {
    let campaign = std::env::var_os("TAXEL_CAMPAIGN").is_some();
    if campaign {
        println!("objects on which the map was tuned:");
        table(tuned, 0..25);
    }
    println!("other objects:");
    let [count, right, follows] = table(other, if campaign { 1000..1100 } else { 1000..1008 });
    println!("{right} of {count} right, {follows} followed as stated");
    assert!(right * 10 >= count * 9, "{right} of {count}");
    // Whatever is reported right is answered as stated.
    assert_eq!(follows, right);
}

/// What others do to the robot counts for what its limb does, and the other way round.
#[test]
fn the_two_maps_of_a_robot_are_one_by_their_common_concepts() {
    let file = prober().map;
    let map = BoardMap::build(&file).unwrap();
    let value = |inputs: &[(&str, f64)], of: &str| {
        let at = |name: &str| file.find(name).unwrap();
        let start =
            map.state(inputs.iter().map(|(name, value)| (at(name), Decimal::from_f64(*value).unwrap())));
        map.value(map.infer(&start).state[at(of)])
    };
    let soft = [("own", 1.0), ("rigid", -1.0), ("pointed", -1.0)];
    assert!(value(&soft, "soft") > 0.9 && value(&soft, "hold") > 0.9 && value(&soft, "avoid") == 0.0);
    // An embrace is held, an attack and a threat avoided, whatever the limb does not probe.
    let hug = [("chest", 1.0), ("back", 1.0)];
    assert!(value(&hug, "kindness") > 0.5 && value(&hug, "hold") > 0.5 && value(&hug, "soft") == 0.0);
    for word in ["board attack", "board threat"] {
        assert!(value(&[(word, 1.0), ("rigid", -1.0)], "avoid") > 0.5, "{word}");
        assert_eq!(value(&[(word, 1.0), ("rigid", -1.0)], "hold"), 0.0, "{word}");
    }
    // What the limb has met attacks nobody, however hard; a blow beside it is avoided, and not held.
    let bump = [("own", 1.0), ("rigid", 1.0), ("pointed", -1.0), ("board attack", 1.0)];
    assert!(value(&bump, "attack") == 0.0 && value(&bump, "explore") > 0.9);
    let beside = [("own", 0.5), ("rigid", -1.0), ("pointed", -1.0), ("board attack", 1.0)];
    assert!(value(&beside, "avoid") > 0.5 && value(&beside, "hold") == 0.0);
}
