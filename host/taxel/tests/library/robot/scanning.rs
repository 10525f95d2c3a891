//! Boards that scan simulated panels at times of their own.

use taxel::robot::{BoardScan, ScanReader};
use taxel::stepped::Stepped;
use taxel_core::condition::Filter;
use taxel_core::format::Micros;
use taxel_core::garment::Garment;
use taxel_core::scene::Scene;
use taxel_core::wire::Request;
use taxel_sim::World;

/// Host time at which all boards begin, us.
pub const BEGAN_US: u64 = 1_000_000;

/// A garment of one panel of so many rows and columns, which are multiples of 4 and 16, at most 16 blocks.
pub fn panel([rows, columns]: [u16; 2], [x_um, y_um]: [u32; 2]) -> Garment {
    let across = columns / 16;
    let block = |block: u16| {
        let (row, column) = (4 * (block / across), 16 * (block % across));
        format!(
            "{{ panel = 0, row = {row}, column = {column}, rows = 4, columns = 16, input = {}, select = {} }}",
            26 + block / 4,
            block % 4
        )
    };
    let blocks: Vec<String> = (0..rows / 4 * across).map(block).collect();
    let text = format!(
        "name = \"panel\"\nblocks = [{}]\n[wiring]\nsettle_ns = 3000\n\
         block = {{ coding = \"binary\", lines = [{{ pin = 2 }}, {{ pin = 3 }}, {{ pin = 6 }}] }}\n\
         row = {{ coding = \"binary\", lines = [{{ pin = 7 }}, {{ pin = 8 }}] }}\n\
         column = {{ coding = \"binary\", lines = [{{ pin = 9 }}, {{ pin = 10 }}, {{ pin = 11 }}, {{ pin = 12 }}] }}\n\
         [[panels]]\nname = \"mat\"\nlink = \"base\"\nregion = \"mat\"\nrows = {rows}\ncolumns = {columns}\n\
         pitch_um = [{x_um}, {y_um}]\n",
        blocks.join(", ")
    );
    toml::from_str(&text).unwrap()
}

/// A board that scans.
pub struct Scanning<'a> {
    pub board: Stepped,
    reader: ScanReader,
    world: &'a World,
    /// Number of its first taxel in the world.
    first: usize,
    /// Times of the next scan and between two, us.
    pub next_us: u64,
    period_us: u64,
}

impl<'a> Scanning<'a> {
    /// A board that wears this garment, and tares first.
    pub fn new(
        world: &'a World,
        first: usize,
        garment: Garment,
        reader: ScanReader,
        filter: Filter,
        [next_us, period_us]: [u64; 2],
    ) -> Scanning<'a> {
        let mut scene = Scene::shipped();
        scene.condition.filter = filter;
        let mut board = Stepped::new(garment, scene).unwrap();
        board.client().request(&Request::Tare { frames: 8 }).unwrap();
        Scanning { board, reader, world, first, next_us, period_us }
    }

    /// The next scan: its time, and what is told of it.
    pub fn scan(&mut self) -> (u64, Vec<BoardScan>) {
        let time = self.next_us;
        let code = |taxel: usize| self.world.code(self.first + taxel, time * 1000);
        let codes: Vec<u16> = (0..self.board.taxels()).map(code).collect();
        let mut scans = Vec::new();
        let mut told = |client: &taxel::client::Client, event: &taxel::client::Event| {
            scans.extend(self.reader.scan(client, event));
            Ok(())
        };
        self.board.step(&codes, Micros(time), &mut told).unwrap();
        self.next_us += self.period_us;
        (time, scans)
    }
}
