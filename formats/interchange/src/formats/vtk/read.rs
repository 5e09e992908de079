//! Legacy VTK, versions 1 to 5, ASCII and binary: unstructured grids and polygonal data.
//!
//! Format: "VTK File Formats", section "Simple Legacy Formats". Binary numbers are big-endian.

use super::fields::{NAMES, take_names};
use crate::ReadError;
use crate::binary::{Order, Scalar, id};
use crate::parsed::{Grid, Parsed, PointMesh};
use crate::text::{DOUBLE, SINGLE, Tokens, shown};
use glam::DVec3;

const MAGIC: &[u8] = b"# vtk DataFile Version ";

/// Whether the bytes begin like a file of this format.
pub fn looks_like(head: &[u8]) -> bool {
    head.starts_with(MAGIC)
}

/// A number type of the format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// Eight to a byte in binary files. No array of them is of use here.
    Bit,
    Of(Scalar),
}

impl Kind {
    fn from_name(name: &[u8]) -> Option<Self> {
        Some(Self::Of(match name {
            b"bit" => return Some(Self::Bit),
            b"char" | b"signed_char" => Scalar::Signed(1),
            b"unsigned_char" => Scalar::Unsigned(1),
            b"short" => Scalar::Signed(2),
            b"unsigned_short" => Scalar::Unsigned(2),
            b"int" => Scalar::Signed(4),
            b"unsigned_int" => Scalar::Unsigned(4),
            b"long" | b"vtkidtype" | b"vtktypeint64" => Scalar::Signed(8),
            b"unsigned_long" | b"vtktypeuint64" => Scalar::Unsigned(8),
            b"float" => Scalar::Float,
            b"double" => Scalar::Double,
            _ => return None,
        }))
    }
}

/// The type of old files' lists of cells and of cell types.
const INT: Kind = Kind::Of(Scalar::Signed(size_of::<i32>()));
/// The type of colours.
const BYTE: Kind = Kind::Of(Scalar::Unsigned(size_of::<u8>()));

/// Reads a file.
pub fn read(bytes: &[u8]) -> Result<Parsed, ReadError> {
    Reader::new(bytes, false)?.read()?.parsed("vtk")
}

/// Reads the mesh of a file with the numbers at its points.
pub fn read_points(bytes: &[u8]) -> Result<PointMesh, ReadError> {
    Reader::new(bytes, true)?.read()?.point_mesh("vtk")
}

struct Reader<'a> {
    tokens: Tokens<'a>,
    bytes: &'a [u8],
    binary: bool,
    polydata: bool,
    grid: Grid,
    /// Whether the arrays that follow are on cells.
    on_cells: bool,
    /// Whether arrays on points are kept.
    keeps_points: bool,
    /// Whether the arrays that follow are on points.
    on_points: bool,
}

impl<'a> Reader<'a> {
    fn new(bytes: &'a [u8], keeps_points: bool) -> Result<Self, ReadError> {
        let mut tokens = Tokens::new(bytes, "vtk", None);
        if !looks_like(bytes) {
            return Err(tokens.error("it does not begin with '# vtk DataFile Version'"));
        }
        tokens.rest_of_line();
        tokens.skip(1);
        let title = String::from_utf8_lossy(tokens.rest_of_line()).into_owned();
        let binary = match tokens.next_word() {
            Some(b"ASCII") => false,
            Some(b"BINARY") => true,
            other => {
                let found = shown(other.unwrap_or_default());
                return Err(tokens.error(format!("'ASCII' or 'BINARY' expected, found '{found}'")));
            }
        };
        if binary {
            tokens.count_bytes();
        }
        tokens.expect("DATASET")?;
        let polydata = match tokens.next_word() {
            Some(b"UNSTRUCTURED_GRID") => false,
            Some(b"POLYDATA") => true,
            other => {
                let found = shown(other.unwrap_or_default());
                return Err(tokens.error(format!(
                    "only UNSTRUCTURED_GRID and POLYDATA are read, this is '{found}'"
                )));
            }
        };
        Ok(Self {
            tokens,
            bytes,
            binary,
            polydata,
            grid: Grid {
                title,
                ..Grid::default()
            },
            on_cells: false,
            keeps_points,
            on_points: false,
        })
    }

    fn read(mut self) -> Result<Grid, ReadError> {
        while let Some(word) = self.tokens.next_word() {
            match word {
                b"POINTS" => self.points()?,
                b"CELLS" => self.cells(None)?,
                b"VERTICES" => self.cells(Some(2))?,
                b"LINES" => self.cells(Some(4))?,
                b"POLYGONS" => self.cells(Some(7))?,
                b"TRIANGLE_STRIPS" => self.cells(Some(6))?,
                b"CELL_TYPES" => self.types()?,
                b"CELL_DATA" | b"POINT_DATA" => {
                    self.on_cells = word == b"CELL_DATA";
                    self.on_points = !self.on_cells;
                    self.tokens.rest_of_line();
                }
                b"FIELD" => self.field()?,
                b"METADATA" => self.metadata(),
                _ => self.attribute(word)?,
            }
        }
        let grid = &self.grid;
        if grid.types.len() != grid.ends.len() {
            return Err(self.tokens.error(format!(
                "{} cells have {} types",
                grid.ends.len(),
                grid.types.len()
            )));
        }
        Ok(self.grid)
    }

    fn kind(&mut self) -> Result<Kind, ReadError> {
        let word = self.tokens.next_word().unwrap_or_default();
        Kind::from_name(&word.to_ascii_lowercase()).ok_or_else(|| {
            self.tokens
                .error(format!("the type '{}' is not known", shown(word)))
        })
    }

    /// The next `count` numbers.
    fn numbers(
        &mut self,
        count: usize,
        kind: Kind,
        what: &str,
        mut sink: impl FnMut(f64),
    ) -> Result<(), ReadError> {
        let left = self.tokens.left();
        let too_many = |needed: u128| {
            (needed > left as u128)
                .then(|| format!("{what} needs {needed} bytes at least, and {left} are left"))
        };
        if !self.binary {
            if let Some(reason) = too_many(2 * count as u128 - u128::from(count > 0)) {
                return Err(self.tokens.error(reason));
            }
            for _ in 0..count {
                sink(self.tokens.number()?);
            }
            return Ok(());
        }
        // One byte ends the line before.
        self.tokens.rest_of_line();
        self.tokens.skip(1);
        let size = match kind {
            Kind::Bit => count.div_ceil(8) as u128,
            Kind::Of(scalar) => count as u128 * scalar.size() as u128,
        };
        if size > self.tokens.left() as u128 {
            return Err(self.tokens.error(format!(
                "{what} needs {size} bytes, and {} are left",
                self.tokens.left()
            )));
        }
        let begin = self.bytes.len() - self.tokens.left();
        let data = &self.bytes[begin..begin + size as usize];
        if let Kind::Of(scalar) = kind {
            for item in data.chunks_exact(scalar.size()) {
                sink(scalar.value(item, Order::Big));
            }
        }
        self.tokens.skip(size as usize);
        Ok(())
    }

    fn points(&mut self) -> Result<(), ReadError> {
        let count = self.tokens.count("the number of points")?;
        let kind = self.kind()?;
        let mut values = Vec::new();
        let numbers = count.saturating_mul(3);
        self.numbers(numbers, kind, "POINTS", |x| values.push(x))?;
        self.grid.relative_precision = if kind == Kind::Of(Scalar::Float) {
            SINGLE
        } else {
            DOUBLE
        };
        self.grid.points = values
            .chunks_exact(3)
            .map(|p| DVec3::new(p[0], p[1], p[2]))
            .collect();
        Ok(())
    }

    /// Cells, or with `only` polygonal data of this type.
    fn cells(&mut self, only: Option<u8>) -> Result<(), ReadError> {
        let first = self.tokens.count("the number of cells")?;
        let second = self.tokens.count("the number of integers")?;
        let begin = self.grid.connectivity.len();
        let mut ends = Vec::new();
        let mut connectivity = Vec::new();
        if self.tokens.peek() == Some(b"OFFSETS") {
            // Version 5: `first` offsets, of which the first is 0, and `second` point ids.
            self.tokens.next_word();
            let kind = self.kind()?;
            self.numbers(first, kind, "OFFSETS", |x| ends.push(index(x)))?;
            if !ends.is_empty() {
                ends.remove(0);
            }
            self.tokens.expect("CONNECTIVITY")?;
            let kind = self.kind()?;
            self.numbers(second, kind, "CONNECTIVITY", |x| connectivity.push(id(x)))?;
        } else {
            let mut values = Vec::new();
            self.numbers(second, INT, "CELLS", |x| values.push(id(x)))?;
            let mut rest = values.as_slice();
            for i in 0..first {
                let cell = rest
                    .split_first()
                    .and_then(|(&n, after)| after.split_at_checked(n as usize));
                let Some((corners, after)) = cell else {
                    return Err(self
                        .tokens
                        .error(format!("cell {i} of {first} goes beyond the list of cells")));
                };
                connectivity.extend_from_slice(corners);
                ends.push(connectivity.len());
                rest = after;
            }
        }
        if let Some(kind) = only {
            self.grid
                .types
                .resize(self.grid.types.len() + ends.len(), kind);
        }
        self.grid.connectivity.extend(connectivity);
        let ends = ends.into_iter().map(|e| begin.saturating_add(e));
        self.grid.ends.extend(ends);
        Ok(())
    }

    fn types(&mut self) -> Result<(), ReadError> {
        let count = self.tokens.count("the number of cells")?;
        let mut types = Vec::new();
        self.numbers(count, INT, "CELL_TYPES", |x| types.push(x as u8))?;
        if !self.polydata {
            self.grid.types = types;
        }
        Ok(())
    }

    fn field(&mut self) -> Result<(), ReadError> {
        self.tokens.next_word();
        let arrays = self.tokens.count("the number of arrays")?;
        for _ in 0..arrays {
            if self.tokens.peek() == Some(b"METADATA") {
                self.tokens.next_word();
                self.metadata();
            }
            let Some(name) = self.tokens.next_word() else {
                return Err(self
                    .tokens
                    .error("an array expected, but the file ends here"));
            };
            let name = String::from_utf8_lossy(name).into_owned();
            let components = self.tokens.count("the number of components")?;
            let tuples = self.tokens.count("the number of tuples")?;
            let count = components.saturating_mul(tuples);
            if self.tokens.peek() == Some(b"string") {
                return Err(self.tokens.error("arrays of strings are not supported"));
            }
            let kind = self.kind()?;
            if NAMES.contains(&name.as_str()) && self.grid.points.is_empty() {
                self.names(&name, count, kind)?;
            } else {
                self.array(name, count, kind)?;
            }
        }
        Ok(())
    }

    /// Ids, and in the metadata behind them their names.
    fn names(&mut self, array: &str, count: usize, kind: Kind) -> Result<(), ReadError> {
        let mut ids = Vec::new();
        self.numbers(count, kind, array, |x| ids.push(id(x)))?;
        let mut names = Vec::new();
        if self.tokens.peek() == Some(b"METADATA") {
            self.tokens.next_word();
            self.tokens.rest_of_line();
            while let Some(line) = self.metadata_line() {
                if line == b"COMPONENT_NAMES" {
                    let lines = ids.iter().map_while(|_| self.metadata_line());
                    names = lines.map(unescaped).collect();
                }
            }
        }
        take_names(&mut self.grid, array, &ids, &names);
        Ok(())
    }

    /// Keeps an array that may matter: integers on cells, and texts of the data set.
    fn array(&mut self, name: String, count: usize, kind: Kind) -> Result<(), ReadError> {
        let cells = self.grid.types.len().max(self.grid.ends.len());
        let before_cells = self.grid.points.is_empty();
        let known = ["region", "marker", "front", "back"].contains(&name.as_str());
        if self.on_cells && count == cells && known {
            let mut values = Vec::new();
            self.numbers(count, kind, &name, |x| values.push(id(x)))?;
            self.grid.cell_data.insert(name, values);
        } else if self.keeps_points && self.on_points && kind != Kind::Bit {
            let mut values = Vec::new();
            self.numbers(count, kind, &name, |x| values.push(x))?;
            self.grid
                .take_point_data(unescaped(name.as_bytes()), values);
        } else if before_cells && matches!(kind, Kind::Of(Scalar::Signed(1) | Scalar::Unsigned(1)))
        {
            let mut text = Vec::new();
            self.numbers(count, kind, &name, |x| text.push(x as u8))?;
            let text = String::from_utf8_lossy(&text).into_owned();
            self.grid.texts.insert(name, text);
        } else {
            self.numbers(count, kind, &name, |_| {})?;
        }
        Ok(())
    }

    fn attribute(&mut self, word: &[u8]) -> Result<(), ReadError> {
        let name = self.tokens.word_on_line().unwrap_or_default();
        let name = String::from_utf8_lossy(name).into_owned();
        let tuples = if self.on_cells {
            self.grid.types.len().max(self.grid.ends.len())
        } else {
            self.grid.points.len()
        };
        let (components, kind) = match word {
            b"SCALARS" => {
                let kind = self.kind()?;
                let components = self.tokens.integer_on_line("the number of components")?;
                if self.tokens.peek() == Some(b"LOOKUP_TABLE") {
                    self.tokens.next_word();
                    self.tokens.word_on_line();
                }
                (usize::try_from(components.unwrap_or(1)).unwrap_or(1), kind)
            }
            b"VECTORS" | b"NORMALS" => (3, self.kind()?),
            b"TENSORS" => (9, self.kind()?),
            b"GLOBAL_IDS" | b"PEDIGREE_IDS" => (1, self.kind()?),
            b"TEXTURE_COORDINATES" => {
                let n = self.tokens.count("the dimension")?;
                (n, self.kind()?)
            }
            b"COLOR_SCALARS" => {
                let n = self.tokens.count("the number of components")?;
                (n, BYTE)
            }
            b"LOOKUP_TABLE" => {
                let n = self.tokens.count("the number of entries")?;
                return self.numbers(n.saturating_mul(4), BYTE, "LOOKUP_TABLE", |_| {});
            }
            other => {
                return Err(self
                    .tokens
                    .error(format!("'{}' is not known here", shown(other))));
            }
        };
        self.array(name, tuples.saturating_mul(components), kind)
    }

    /// Skips a block of metadata, which an empty line ends.
    fn metadata(&mut self) {
        self.tokens.rest_of_line();
        while self.metadata_line().is_some() {}
    }

    /// The next line of a block of metadata; none at its end.
    fn metadata_line(&mut self) -> Option<&'a [u8]> {
        if self.tokens.left() <= 1 {
            return None;
        }
        self.tokens.skip(1);
        let line = self.tokens.rest_of_line();
        (!line.is_empty()).then_some(line)
    }
}

/// A name in which `%` and two digits stand for a byte.
fn unescaped(text: &[u8]) -> String {
    let digit = |at: usize| text.get(at).and_then(|&c| char::from(c).to_digit(16));
    let mut bytes = Vec::with_capacity(text.len());
    let mut at = 0;
    while let Some(&byte) = text.get(at) {
        match (byte, digit(at + 1), digit(at + 2)) {
            (b'%', Some(high), Some(low)) => {
                bytes.push((16 * high + low) as u8);
                at += 3;
            }
            _ => {
                bytes.push(byte);
                at += 1;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

fn index(x: f64) -> usize {
    x as usize
}
