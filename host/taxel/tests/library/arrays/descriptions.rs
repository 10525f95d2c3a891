//! Descriptions that are wrong, and names of sources.

use taxel::source::array::{ArrayDescription, ArraySpec, described};

/// Text of a description with a change.
fn refused(from: &str, to: &str) -> String {
    let text = "rows = 4\ncolumns = 5\nrange = [0, 1023]\npitch_um = [8000, 8000]\n[link]\nbaud = 115200\n[frame]\n\
                kind = \"bytes\"\nhead = \"AA 55\"\nvalue = \"u8\"\n";
    assert!(text.contains(from) && ArrayDescription::parse(text, "mat.toml").is_ok());
    ArrayDescription::parse(&text.replace(from, to), "mat.toml").unwrap_err().to_string()
}

#[test]
fn errors_name_file_line_and_key() {
    for (from, to, why) in [
        ("rows = 4", "rows = 0", "mat.toml, line 1, `rows`: it must be 1 or more"),
        ("rows = 4", "row = 4", "mat.toml, line 1: `row` is not a known key, did you mean `rows`?"),
        (
            "rows = 4",
            "rows = 500",
            "mat.toml, line 1, `rows`: 2500 values are more than the 2048 taxels of a board",
        ),
        ("1023]", "0]", "mat.toml, line 3, `range`: the first of its two numbers must be less"),
        ("8000]", "8]", "mat.toml, line 4, `pitch_um`: both must be 500 to 200000"),
        ("115200", "0", "mat.toml, line 6, `link.baud`: it must be 1 or more"),
        ("AA 55", "AA 5", "mat.toml, line 9, `frame.head`: \"AA 5\" must be 1 to 8 bytes"),
        ("AA 55", "", "must be 1 to 8 bytes"),
        ("head = \"AA 55\"\n", "", "`frame`: without `head` and `tail` in it and `poll` in [link], no frame"),
        (
            "\"u8\"",
            "\"u8\"\ntime = { at = 19, type = \"u32le\", unit = \"ms\" }",
            "`frame.time`: it must be a whole number within",
        ),
        ("\"u8\"", "\"u9\"", "`u9` is not a known name"),
        ("\"bytes\"", "\"bits\"", "`bits` is not a known name"),
        ("value", "separator", "`separator` is not a known key"),
    ] {
        let reported = refused(from, to);
        assert!(reported.contains(why), "{to}: {reported}");
    }
    assert!(refused("columns = 5", "columns = 5\nsnake = 1").contains("line 3, `snake`"));
    let odd = "rows = 1\ncolumns = 3\n[frame]\nkind = \"bytes\"\nhead = \"AA\"\nvalue = \"u12be\"\n";
    let odd = ArrayDescription::parse(odd, "mat.toml").unwrap_err().to_string();
    assert_eq!(odd, "mat.toml, line 6, `frame.value`: the values end within a byte");
}

#[test]
fn names_of_sources_are_read_and_written() {
    for text in [
        "flexitac:/dev/ttyUSB0",
        "flexitac:COM5@115200,rows=12,columns=32",
        "wiresens:listen:7000,rows=16,columns=16,id=1",
        "wiresens:tcp:10.0.0.2:7000",
        "numbers:-,rows=12,columns=21,range=0..1023",
        "numbers:udp:7000,rows=2,columns=2,pitch_mm=5x8",
        "a/mat.toml:/dev/ttyACM0",
        "mat.toml:file:/tmp/a,b.bin,rate=50",
    ] {
        assert_eq!(ArraySpec::read(text).unwrap().unwrap().to_string(), text);
    }
    for text in ["sim:pat", "mat.toml", "tcp:host:1", "/dev/ttyACM0", "flexitacs:-"] {
        assert_eq!(ArraySpec::read(text), None, "{text}");
    }
    for (text, why) in [
        ("flexitac", "\"\" is no link: known are a serial port"),
        ("flexitac:ttyUSB0", "\"ttyUSB0\" is no link"),
        ("flexitac:/dev/a@b", "PORT@BAUD needs a number of bits per second, not \"b\""),
        ("flexitac:udp:99999", "\"99999\" must be a port number"),
        ("flexitac:-,rows=2,rows=3", "`rows` is given twice"),
        ("flexitac:-,row=2", "there is no key \"row\": did you mean \"rows\"?"),
        ("vitac:-,rows=2", "there is no key \"rows\""),
        ("flexitac:-,rate=2", "there is no key \"rate\""),
        ("flexitac:-,rows=2,x", "\"x\" must be key=value"),
    ] {
        let reported = ArraySpec::read(text).unwrap().unwrap_err();
        assert!(reported.contains(why), "{text}: {reported}");
    }
}

#[test]
fn keys_change_a_format() {
    let read = |text: &str| described(&ArraySpec::read(text).unwrap().unwrap());
    let anyskin = read("anyskin:-,chips=10,range=0..500").unwrap();
    assert_eq!((anyskin.shape(), anyskin.values(), anyskin.range), ([10, 1], 40, Some([0., 500.])));
    let flexitac = read("flexitac:-,rows=12,pitch_mm=5x8,falling=true").unwrap();
    assert_eq!((flexitac.shape(), flexitac.pitch_um, flexitac.falling), ([12, 32], Some([5000, 8000]), true));
    for (text, why) in [
        ("anyskin:-", "anyskin:-: this format states no range: add range=LOW..HIGH"),
        ("numbers:-,rows=2", "numbers:-,rows=2: `columns` is missing: add columns=N"),
        ("flexitac:-,rows=0", "`rows`: it must be 1 or more"),
        ("flexitac:-,rows=a", "`rows`: \"a\" must be a whole number of 0 to 65535"),
        ("flexitac:-,range=3..3", "`range`: the first of its two numbers must be less than the second"),
        ("flexitac:-,range=3", "`range`: it must be LOW..HIGH, such as 0..1023"),
        ("none.toml:-", "cannot read none.toml"),
    ] {
        let reported = taxel::text::words::sentence(&read(text).unwrap_err());
        assert!(reported.contains(why), "{text}: {reported}");
    }
}
