//! The checked wiring of a garment: levels of the lines for each block, row and column, and the taxels read
//! there.

use super::area::{Area, Place};
use super::config::{BLOCKS, Block, CIRCUIT_LINES, Coding, Garment, Group, LINES, Line};
use super::error::GarmentError;
use super::layout::Layout;
use super::pins::Pins;
use heapless::Vec;

/// Wiring of a block: the taxel at wired row r and column c is `origin + r row_step + c column_step`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Site {
    /// Index of the block in the garment.
    pub block: u8,
    /// Index of its panel.
    pub panel: u8,
    /// GPIO number of the converter input.
    pub input: u8,
    /// Wired rows.
    pub rows: u8,
    /// Wired columns.
    pub columns: u8,
    /// Code of the block lines.
    pub select: u16,
    /// Taxel at wired row 0, column 0.
    pub origin: i32,
    /// Step of the taxel number per wired row.
    pub row_step: i32,
    /// Step of the taxel number per wired column.
    pub column_step: i32,
    /// Position of wired row 0, column 0: row of the panel modulo 8, times 8, plus its column modulo 8.
    pub corner: u8,
}

impl Site {
    /// Number of the taxel at a wired row and column of the block.
    pub const fn taxel(&self, row: u8, column: u8) -> usize {
        (self.origin + row as i32 * self.row_step + column as i32 * self.column_step) as usize
    }

    /// Row and column of the panel, modulo 8, at a wired row and column of the block. On a panel of one
    /// column a step counts as a column.
    pub const fn place(&self, row: u8, column: u8) -> (i32, i32) {
        let (mut y, mut x) = ((self.corner >> 3) as i32, (self.corner & 7) as i32);
        let by_row = row as i32 * self.row_step.signum();
        let by_column = column as i32 * self.column_step.signum();
        *(if self.row_step.abs() == 1 { &mut x } else { &mut y }) += by_row;
        *(if self.column_step.abs() == 1 { &mut x } else { &mut y }) += by_column;
        (y, x)
    }
}

/// The checked wiring. Levels of all lines form one word, bit `i` for `lines()[i]`: block lines first, then
/// row lines, column lines and enables.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub struct Circuit {
    lines: Vec<u8, CIRCUIT_LINES>,
    inverted: u32,
    enabled: u32,
    groups: [(Coding, u8); 3],
    sites: Vec<Site, BLOCKS>,
    settle_ns: u32,
    falling: bool,
}

impl Circuit {
    /// Checks the wiring of `garment`, whose geometry is `layout`, against the `pins` of a board.
    pub fn build(garment: &Garment, layout: &Layout, pins: Pins) -> Result<Circuit, GarmentError> {
        // A board without a converter, whose codes come from elsewhere, has nothing to select.
        if pins.inputs == 0 && garment.blocks.is_empty() {
            return Ok(Circuit::default());
        }
        let wiring = &garment.wiring;
        let mut circuit = Circuit {
            lines: Vec::new(),
            inverted: 0,
            enabled: 0,
            groups: [(Coding::Binary, 0); 3],
            sites: Vec::new(),
            settle_ns: wiring.settle_ns,
            falling: wiring.falling,
        };
        for (slot, group) in circuit.groups.iter_mut().zip([&wiring.block, &wiring.row, &wiring.column]) {
            *slot = (group.coding, group.lines.len() as u8);
        }
        for group in [&wiring.block, &wiring.row, &wiring.column] {
            circuit.add_lines(&group.lines, pins)?;
        }
        let selects = circuit.lines.len();
        circuit.add_lines(&wiring.enable, pins)?;
        circuit.enabled = mask(circuit.lines.len()) & !mask(selects);
        for (index, block) in garment.blocks.iter().enumerate() {
            circuit.add_block(index, block, garment, layout, pins)?;
        }
        check_cover(garment, layout)?;
        if circuit.sites.is_empty() {
            return Err(GarmentError::NoBlock);
        }
        in_order_of_scan(&mut circuit.sites);
        for pair in circuit.sites.windows(2) {
            if let [a, b] = pair
                && (a.select, a.input) == (b.select, b.input)
            {
                let (a, b) = (usize::from(a.block), usize::from(b.block));
                return Err(GarmentError::SameSelect(a.min(b), a.max(b)));
            }
        }
        Ok(circuit)
    }

    fn add_lines(&mut self, lines: &[Line], pins: Pins) -> Result<(), GarmentError> {
        for line in lines {
            if !pins.is_output(line.pin) {
                return Err(GarmentError::NoOutput { pin: line.pin, why: pins.why_no_output(line.pin) });
            }
            if self.lines.contains(&line.pin) {
                return Err(GarmentError::PinTwice(line.pin));
            }
            if line.inverted {
                self.inverted |= 1 << self.lines.len();
            }
            self.lines.push(line.pin).map_err(|_| GarmentError::TooManyLines)?;
        }
        Ok(())
    }

    fn add_block(
        &mut self,
        index: usize,
        block: &Block,
        garment: &Garment,
        layout: &Layout,
        pins: Pins,
    ) -> Result<(), GarmentError> {
        let area = layout.area_of("block", index, block.panel)?;
        if !pins.is_input(block.input) {
            return Err(GarmentError::NoAdc { block: index, pin: block.input, inputs: pins.inputs });
        }
        if self.lines.contains(&block.input) {
            return Err(GarmentError::PinTwice(block.input));
        }
        let (width, height) = extent(block);
        if width == 0
            || height == 0
            || u32::from(block.column) + width > u32::from(area.columns)
            || u32::from(block.row) + height > u32::from(area.rows)
        {
            return Err(GarmentError::OutsidePanel { what: "block", index, panel: area.name.clone() });
        }
        let wiring = &garment.wiring;
        check_code(index, "block", &wiring.block, u32::from(block.select))?;
        check_code(index, "row", &wiring.row, u32::from(block.rows) - 1)?;
        check_code(index, "column", &wiring.column, u32::from(block.columns) - 1)?;
        let _ = self.sites.push(site(index, block, area));
        Ok(())
    }

    /// GPIO numbers of the output lines, in the order of the bits of a word.
    pub fn lines(&self) -> &[u8] {
        &self.lines
    }

    /// The blocks, in the order of the scan: by select code, then by input.
    pub fn sites(&self) -> &[Site] {
        &self.sites
    }

    /// Wiring of a taxel: index of its block, row and column within it; none for absent taxels. Searches all
    /// blocks.
    pub fn wired(&self, taxel: usize) -> Option<(u8, u8, u8)> {
        self.sites.iter().find_map(|site| {
            let mut places =
                (0..site.rows).flat_map(|row| (0..site.columns).map(move |column| (row, column)));
            let (row, column) = places.find(|(row, column)| site.taxel(*row, *column) == taxel)?;
            Some((site.block, row, column))
        })
    }

    /// Blocks by select code: those of one code are read together.
    pub fn selects(&self) -> impl Iterator<Item = &[Site]> {
        let mut rest = self.sites.as_slice();
        core::iter::from_fn(move || {
            let select = rest.first()?.select;
            let count = rest.iter().take_while(|site| site.select == select).count();
            // `chunk_by` would leave a panic in the image, which the linker would find.
            let (sites, others) = rest.split_at_checked(count)?;
            rest = others;
            Some(sites)
        })
    }

    /// Electrical levels of all lines for a block's select code, row and column.
    pub fn word(&self, select: u16, row: u8, column: u8) -> u32 {
        let mut word = self.enabled;
        let mut shift = 0;
        for ((coding, lines), code) in self.groups.iter().zip([select, u16::from(row), u16::from(column)]) {
            let bits = match coding {
                Coding::Binary => u32::from(code),
                Coding::OneHot => 1u32.checked_shl(u32::from(code)).unwrap_or(0),
            };
            // A group without lines may come after 32 lines.
            word |= (bits & mask(usize::from(*lines))).checked_shl(shift).unwrap_or(0);
            shift += u32::from(*lines);
        }
        word ^ self.inverted
    }

    /// Levels at which nothing is asserted: multiplexers disabled, all codes zero.
    pub fn idle_word(&self) -> u32 {
        self.inverted
    }

    /// Time from a change of the select lines to the sample, nanoseconds.
    pub fn settle_ns(&self) -> u32 {
        self.settle_ns
    }

    /// True if pressure lowers the code.
    pub fn falling(&self) -> bool {
        self.falling
    }
}

const fn mask(bits: usize) -> u32 {
    if bits >= 32 { u32::MAX } else { (1 << bits) - 1 }
}

/// Width and height of a block in its panel.
fn extent(block: &Block) -> (u32, u32) {
    let (rows, columns) = (u32::from(block.rows), u32::from(block.columns));
    if block.orientation.transposed { (rows, columns) } else { (columns, rows) }
}

fn check_code(block: usize, group: &'static str, lines: &Group, code: u32) -> Result<(), GarmentError> {
    const { assert!(LINES < 32, "a group's codes must fit u32") };
    let codes = lines.codes();
    if code < codes { Ok(()) } else { Err(GarmentError::Code { block, group, code, codes }) }
}

fn site(index: usize, block: &Block, area: &Area) -> Site {
    let stride = i32::from(area.columns);
    let (width, height) = extent(block);
    let turn = block.orientation;
    let (x_step, x0) = if turn.mirror_x { (-1, width as i32 - 1) } else { (1, 0) };
    let (y_step, y0) = if turn.mirror_y { (-stride, height as i32 - 1) } else { (stride, 0) };
    let (row, column) = (i32::from(block.row) + y0, i32::from(block.column) + x0);
    let (row_step, column_step) = if turn.transposed { (x_step, y_step) } else { (y_step, x_step) };
    let origin = i32::from(area.base) + row * stride + column;
    Site {
        block: index as u8,
        panel: block.panel,
        input: block.input,
        rows: block.rows,
        columns: block.columns,
        select: block.select,
        origin,
        row_step,
        column_step,
        corner: (row as u8 & 7) << 3 | column as u8 & 7,
    }
}

/// Sorts by select code, then by input. By insertion: the library's sort can panic if an order is
/// inconsistent.
fn in_order_of_scan(sites: &mut [Site]) {
    for end in 1..sites.len() {
        for at in (0..end).rev() {
            if let Some([a, b, ..]) = sites.get_mut(at..)
                && (b.select, b.input) < (a.select, a.input)
            {
                core::mem::swap(a, b);
            }
        }
    }
}

/// Checks that every taxel that is not absent lies in exactly one block.
fn check_cover(garment: &Garment, layout: &Layout) -> Result<(), GarmentError> {
    let holds = |block: &Block, place: Place| {
        let (width, height) = extent(block);
        block.panel == place.panel
            && place.row >= block.row
            && u32::from(place.row - block.row) < height
            && place.column >= block.column
            && u32::from(place.column - block.column) < width
    };
    for (panel, area) in layout.areas().iter().enumerate() {
        for row in 0..area.rows {
            for column in 0..area.columns {
                let place = Place { panel: panel as u8, row, column };
                let mut covering =
                    garment.blocks.iter().enumerate().filter(|(_, b)| holds(b, place)).map(|(i, _)| i);
                match (covering.next(), covering.next()) {
                    (Some(a), Some(b)) => return Err(GarmentError::Overlap(a, b)),
                    (None, _) if !layout.is_absent(panel as u8, row, column) => {
                        return Err(GarmentError::Uncovered { panel: area.name.clone(), row, column });
                    }
                    _ => {}
                }
            }
        }
    }
    Ok(())
}
