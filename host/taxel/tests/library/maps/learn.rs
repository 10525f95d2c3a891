//! Learning from labelled touches.

use taxel::fcm::board::BoardMap;
use taxel::fcm::learn::{changed, learn};
use taxel::fcm::map::MapFile;
use taxel::fcm::weight::Weight;
use taxel::fcm::{load, touches};

/// Touches that the shipped map classifies with a clear lead, labelled by it.
fn labelled(map: &MapFile) -> String {
    let board = BoardMap::build(map).unwrap();
    let of = |name: &str| map.find(name).unwrap();
    let intentions = ["kindness", "threat", "attack"];
    let columns = ["press", "shape", "goodwill", "time"];
    let mut text = format!("{},label\n", columns.join(","));
    let mut random = 12345u64;
    while text.lines().count() < 91 {
        let cells: Vec<i128> = (0..4)
            .map(|_| {
                random = random.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
                2 * i128::from((random >> 33) % 101) - 100
            })
            .collect();
        let decimal = |at: usize| taxel::fcm::decimal::Decimal { digits: cells[at], decimals: 2 };
        let run = board.infer(&board.state((0..4).map(|at| (of(columns[at]), decimal(at)))));
        let mut values: Vec<(f64, &str)> =
            intentions.iter().map(|name| (board.value(run.state[of(name)]), *name)).collect();
        values.sort_by(|a, b| b.0.total_cmp(&a.0));
        if values[0].0 > 0.6 && values[0].0 - values[1].0 > 0.3 {
            let cells: Vec<String> = cells.iter().map(|c| format!("{}", *c as f64 / 100.0)).collect();
            text += &format!("{},{}\n", cells.join(","), values[0].1);
        }
    }
    text
}

#[test]
fn a_spoilt_map_learns_again_and_keeps_what_the_expert_fixed() {
    let good = load::map("tactile").unwrap();
    let mut spoilt = good.clone();
    for (from, to, weight) in [
        ("threat", "kindness", -0.05),
        ("sting", "kindness", -0.05),
        ("grip", "kindness", -0.05),
        ("press", "kindness", -0.05),
        ("press", "grip", 0.05),
        ("sting", "threat", 0.05),
        ("time", "sting", -0.05),
    ] {
        let at = good.edge.iter().position(|edge| edge.from == from && edge.to == to).unwrap();
        assert_eq!(good.edge[at].weight.value().signum(), f64::signum(weight));
        spoilt.edge[at].weight = Weight::Number(weight);
    }
    spoilt.edge[13].fixed = true;
    let text = labelled(&good);
    let touches = touches::parse(&text, &spoilt, &BoardMap::build(&spoilt).unwrap()).unwrap();
    let learned = learn(&spoilt, &touches, 3).unwrap();
    let accuracies = [&learned.before, &learned.cross, &learned.after].map(|judged| judged.accuracy());
    println!(
        "before, left out, after: {accuracies:.3?}; {} weights changed",
        changed(&spoilt, &learned.map).count()
    );
    assert!(accuracies[0] < 0.95 && accuracies[1] > 0.95 && accuracies[2] >= accuracies[1], "{accuracies:?}");
    assert_eq!(learned.map.edge.len(), spoilt.edge.len());
    for (before, after) in spoilt.edge.iter().zip(&learned.map.edge) {
        assert_eq!(before.weight.value().signum(), after.weight.value().signum());
        assert!(!before.fixed || before.weight == after.weight);
    }
    assert!(changed(&spoilt, &learned.map).count() > 0);
    assert_eq!(learn(&spoilt, &touches, 3).unwrap().map, learned.map, "the same again");
}

/// A map that is right already hardly changes, and weights without effect on the labels do not change.
#[test]
fn what_helps_nothing_stays() {
    let good = load::map("tactile").unwrap();
    let touches = touches::parse(&labelled(&good), &good, &BoardMap::build(&good).unwrap()).unwrap();
    let learned = learn(&good, &touches, 2).unwrap();
    assert_eq!(changed(&good, &learned.map).collect::<Vec<_>>(), []);
    assert_eq!((learned.before.accuracy(), learned.after.accuracy()), (1.0, 1.0));
}

#[test]
fn a_bad_table_is_refused_by_line() {
    let map = load::map("tactile").unwrap();
    let board = BoardMap::build(&map).unwrap();
    for (text, message) in [
        ("", "it is empty"),
        ("press,time\n", "line 1: there is no column label"),
        ("force,label\n", "line 1: column force is not a concept of the map"),
        ("anger,label\n", "line 1: column anger is a concept that has causes"),
        ("press,label\n0.5\n", "line 2: 1 values, and there are 2 columns"),
        ("press,label\n0.5,attack\nNaN,none\n", "line 3: press = \"NaN\" is not a number in -1 ..= 1"),
        ("press,label\n1.5,attack\n", "line 2: press = \"1.5\" is not a number in -1 ..= 1"),
        ("press,label\n0.5,joy\n", "line 2: label joy is neither a concept with causes nor none"),
        ("press,label\n0.5,attack\n", "there must be touches of at least two labels"),
    ] {
        let error = touches::parse(text, &map, &board).err().unwrap();
        assert_eq!(format!("{error:#}"), message);
    }
    let grouped = "press,label,group\n0.5,attack,x\n0,none,x\n0.4,attack,y\n0,none,z\n";
    let touches = touches::parse(grouped, &map, &board).unwrap();
    assert_eq!(touches.folds(3), [0, 0, 1, 2], "a group is never parted");
}
