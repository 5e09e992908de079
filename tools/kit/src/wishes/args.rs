//! What is asked of the elements on the command line, by every tool that meshes or prepares for it.

use super::size_field::SizeFieldFile;
use crate::Failure;
use geom::tet::REGULAR_RADIUS_EDGE;
use tmesh::{Deviation, Document, Size, Wishes};

/// Bounds and sizes of elements. What is not given is inherited from the tools before.
#[derive(clap::Args, Clone, Debug, Default)]
pub struct WishArgs {
    /// Largest ratio of circumradius to shortest edge of a tetrahedron [default: inherited, or 1.4]
    #[arg(long, value_name = "R", allow_negative_numbers = true, value_parser = radius_edge)]
    radius_edge: Option<f64>,

    /// Smallest dihedral angle, degrees [default: inherited, or 10]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, value_parser = min_dihedral)]
    min_dihedral: Option<f64>,

    /// Largest tetrahedron volume, model units cubed
    #[arg(long, value_name = "V", allow_negative_numbers = true, value_parser = positive)]
    #[arg(conflicts_with = "edge_length")]
    max_volume: Option<f64>,

    /// Length of edges in the mean, model units: no tetrahedron is larger than a quarter of its cube, and where the surface is
    /// remeshed, its edges get this length, up or down, as far as the deviation allows
    #[arg(long, value_name = "H", allow_negative_numbers = true, value_parser = positive)]
    edge_length: Option<f64>,

    /// Size in one region, by its name or id: `max-volume`, largest tetrahedron volume, or `edge-length`, length of its edges, in place of
    /// those asked for elsewhere; of the faces between two regions the shorter one holds; repeatable
    #[arg(long, value_name = "NAME:KEY=SIZE", value_parser = region_size)]
    region: Vec<RegionSize>,

    /// Lengths of edges that change from place to place, model units: the only array with one number at each point of a mesh in FILE, or
    /// the one that is named; VTK, VTU or MSH, linear within its tetrahedra. The least of the lengths at all images of a place counts, and
    /// of those asked for otherwise; beyond that mesh, lengths grow by the gradation
    #[arg(long, value_name = "FILE[:ARRAY]", value_parser = SizeFieldFile::parse)]
    size_field: Option<SizeFieldFile>,

    /// Elements across walls, at least: sizes are at most this part of the distance through the material to the opposite
    /// face, and grow from there by the gradation
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = layers)]
    layers_across: Option<u32>,

    /// Dihedral angle, degrees, above which tetrahedra are optimized away, and half of what it leaves of 180
    /// the angle below which they are, and once that is done, up to five degrees above it; `off` removes only the
    /// nearly flat ones [default: inherited, or 130]
    #[arg(long, value_name = "DEG|off", value_parser = optimize)]
    optimize: Option<f64>,

    /// How far the surface that is meshed may be from the input's, relative to the radius about the axis; 0 keeps every
    /// triangle, `auto` allows the tolerance of the symmetry, or what the input is off it if that is more, or what chords of
    /// the edge length asked for take, and keeps all where the input has a symmetry exactly, but for what is drawn four times
    /// as fine as that length, or in strips that take three times the triangles that the shape does, and for vertices that no
    /// flat facet needs and that are near others [default: inherited, or auto]
    #[arg(long, value_name = "REL|auto", allow_negative_numbers = true, value_parser = deviation)]
    deviation: Option<Deviation>,

    /// Angle between triangles, degrees, from which on their edge is a feature that stays [default: inherited, or 30]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, value_parser = feature_angle)]
    feature_angle: Option<f64>,

    /// Edges in a whole turn of a curved surface, where it is remeshed [default: inherited, or 12 at least, but no
    /// finer than the input's]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = segments)]
    segments_per_turn: Option<f64>,

    /// Largest ratio of the lengths of edges that follow each other, where the surface is remeshed [default: inherited, or 1.5]
    #[arg(long, value_name = "G", allow_negative_numbers = true, value_parser = gradation)]
    gradation: Option<f64>,

    /// A plain constrained tetrahedralization: no quality bounds, no optimization; `=false` asks for quality where
    /// a tool before was told otherwise
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "true")]
    no_quality: Option<bool>,

    /// Time limit for the mesher and for the improvement of its elements, per template [default: inherited, or none]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = positive)]
    timeout: Option<f64>,
}

/// The size of elements in one region.
#[derive(Clone, Debug, PartialEq)]
struct RegionSize {
    /// Name or id.
    region: String,
    size: Size,
}

/// Dihedral angle of the regular tetrahedron, degrees, arccos(1/3): no tetrahedron's smallest one is
/// larger, nor its largest one smaller.
const REGULAR_DIHEDRAL: f64 = 70.528_779_365_509_31;

impl WishArgs {
    /// The wishes of the command line alone.
    pub fn wishes(&self) -> Wishes {
        let volume = self.max_volume.map(Size::MaxVolume);
        Wishes {
            quality: self.no_quality.map(|plain| !plain),
            radius_edge: self.radius_edge,
            min_dihedral: self.min_dihedral,
            optimize: self.optimize,
            size: volume.or(self.edge_length.map(Size::EdgeLength)),
            deviation: self.deviation,
            feature_angle: self.feature_angle,
            segments_per_turn: self.segments_per_turn,
            gradation: self.gradation,
            layers_across: self.layers_across,
            timeout: self.timeout,
            keep_surface: None,
            moved: None,
        }
    }

    /// Writes the wishes into a document, over those of earlier tools. Bounds that nobody has named are written as well,
    /// as what they are by default: whoever reads the mesh can hold it against them.
    ///
    /// Returns what there is to say about how they fit the document, a sentence each.
    ///
    /// # Errors
    /// A region that the document does not have, as wrong usage; a size field that cannot be read, or is elsewhere.
    pub fn apply(&self, document: &mut Document) -> Result<Vec<String>, Failure> {
        let wishes = self.wishes().over(&document.wishes);
        document.wishes = Wishes {
            radius_edge: Some(wishes.radius_edge()),
            min_dihedral: Some(wishes.min_dihedral()),
            ..wishes
        };
        for size in &self.region {
            let regions = &document.regions;
            let named = regions.iter().position(|r| r.name == size.region);
            let numbered = || regions.iter().position(|r| size.region.parse() == Ok(r.id));
            let Some(index) = named.or_else(numbered) else {
                let known: Vec<_> = regions
                    .iter()
                    .map(|r| format!("'{}' ({})", r.name, r.id))
                    .collect();
                return Err(Failure::Usage(format!(
                    "there is no region '{}'; there are {}",
                    size.region,
                    known.join(", ")
                )));
            };
            document.regions[index].size = Some(size.size);
        }
        let field = self.size_field.as_ref();
        let note = field.map(|field| field.apply(document)).transpose()?;
        Ok(note.flatten().into_iter().collect())
    }
}

fn number(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x.is_finite() => Ok(x),
        _ => Err("not a finite number".to_owned()),
    }
}

fn positive(text: &str) -> Result<f64, String> {
    let x = number(text)?;
    if x > 0.0 {
        Ok(x)
    } else {
        Err("must be above 0".to_owned())
    }
}

fn radius_edge(text: &str) -> Result<f64, String> {
    let x = number(text)?;
    if x > REGULAR_RADIUS_EDGE {
        Ok(x)
    } else {
        Err(format!(
            "must be above {REGULAR_RADIUS_EDGE:.3}, the ratio of the regular tetrahedron"
        ))
    }
}

fn min_dihedral(text: &str) -> Result<f64, String> {
    let x = number(text)?;
    if (0.0..REGULAR_DIHEDRAL).contains(&x) {
        Ok(x)
    } else {
        Err(format!(
            "must be at least 0 and below {REGULAR_DIHEDRAL:.2}, the angle of the regular tetrahedron"
        ))
    }
}

fn optimize(text: &str) -> Result<f64, String> {
    if text == "off" {
        return Ok(180.0);
    }
    let x = number(text)?;
    if x > REGULAR_DIHEDRAL && x < 180.0 {
        Ok(x)
    } else {
        Err(format!(
            "must be between {REGULAR_DIHEDRAL:.2} and 180, or off"
        ))
    }
}

fn deviation(text: &str) -> Result<Deviation, String> {
    if text == "auto" {
        return Ok(Deviation::Auto);
    }
    let x = number(text)?;
    if (0.0..=Deviation::LARGEST).contains(&x) {
        Ok(Deviation::Within(x))
    } else {
        Err(format!("must be from 0 to {}, or auto", Deviation::LARGEST))
    }
}

fn feature_angle(text: &str) -> Result<f64, String> {
    let x = number(text)?;
    if x > 0.0 && x <= 90.0 {
        Ok(x)
    } else {
        Err("must be above 0 and at most 90".to_owned())
    }
}

fn segments(text: &str) -> Result<f64, String> {
    let x = number(text)?;
    if x >= 3.0 {
        Ok(x)
    } else {
        Err("must be at least 3".to_owned())
    }
}

fn gradation(text: &str) -> Result<f64, String> {
    let x = number(text)?;
    if x >= 1.0 {
        Ok(x)
    } else {
        Err("must be at least 1".to_owned())
    }
}

/// Elements across walls. More than a thousand are more than a mesh can have across anything.
fn layers(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(n @ 1..=1000) => Ok(n),
        _ => Err("must be a whole number from 1 to 1000".to_owned()),
    }
}

fn region_size(text: &str) -> Result<RegionSize, String> {
    let volume = text.rsplit_once(":max-volume=");
    let edges = text.rsplit_once(":edge-length=");
    let (region, size) = match (volume, edges) {
        (Some((region, volume)), _) => (region, Size::MaxVolume(positive(volume)?)),
        (None, Some((region, edge))) => (region, Size::EdgeLength(positive(edge)?)),
        (None, None) => return Err("expected NAME:max-volume=V or NAME:edge-length=H".to_owned()),
    };
    if region.is_empty() {
        return Err("the region's name is missing".to_owned());
    }
    Ok(RegionSize {
        region: region.to_owned(),
        size,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;
    use tmesh::{Region, Template};

    #[derive(Parser, Debug)]
    struct Tool {
        #[command(flatten)]
        wishes: WishArgs,
    }

    fn parse(arguments: &[&str]) -> Result<WishArgs, clap::Error> {
        let all = std::iter::once("tool").chain(arguments.iter().copied());
        Ok(Tool::try_parse_from(all)?.wishes)
    }

    #[test]
    fn silence_inherits_and_options_overrule() {
        let mut document = Document::single(Template::default());
        document.wishes.radius_edge = Some(2.0);
        document.wishes.quality = Some(false);
        parse(&["--edge-length", "0.5", "--optimize", "off"])
            .unwrap()
            .apply(&mut document)
            .unwrap();
        let wishes = &document.wishes;
        assert_eq!((wishes.radius_edge(), wishes.quality()), (2.0, false));
        assert_eq!(wishes.optimize(), None);
        assert_eq!(
            wishes.max_volume(),
            Some(Size::EdgeLength(0.5).max_volume())
        );
        assert_eq!(wishes.deviation(), Deviation::Auto);
        parse(&["--deviation", "0", "--feature-angle", "20"])
            .unwrap()
            .apply(&mut document)
            .unwrap();
        let wishes = &document.wishes;
        assert_eq!(wishes.deviation(), Deviation::Within(0.0));
        assert_eq!(wishes.feature_angle(), 20.0);
        assert!(parse(&["--deviation", "0.2"]).is_err());
        parse(&["--segments-per-turn", "20", "--gradation", "1.2"])
            .unwrap()
            .apply(&mut document)
            .unwrap();
        let wishes = &document.wishes;
        assert_eq!(wishes.segments_per_turn, Some(20.0));
        assert_eq!(wishes.gradation(), 1.2);
        assert!(parse(&["--segments-per-turn", "2"]).is_err());
        assert!(parse(&["--gradation", "0.9"]).is_err());
        let more = ["--max-volume", "1", "--no-quality=false"];
        parse(&more).unwrap().apply(&mut document).unwrap();
        assert!(document.wishes.quality());
        assert_eq!(document.wishes.max_volume(), Some(1.0));
        parse(&["--no-quality"])
            .unwrap()
            .apply(&mut document)
            .unwrap();
        assert!(!document.wishes.quality());
    }

    #[test]
    fn sizes_of_regions_are_found_by_name_then_id() {
        let mut document = Document::single(Template::default());
        for (id, name) in [(3, "core"), (5, "7"), (7, "a:b")] {
            document.regions.push(Region {
                id,
                name: name.to_owned(),
                size: None,
                volume: None,
            });
        }
        let sizes = ["--region", "7:max-volume=0.1", "--region", "3:max-volume=4"];
        parse(&sizes).unwrap().apply(&mut document).unwrap();
        parse(&["--region", "a:b:max-volume=1e-3"])
            .unwrap()
            .apply(&mut document)
            .unwrap();
        let sizes = |document: &Document| -> Vec<Option<Size>> {
            document.regions.iter().map(|r| r.size).collect()
        };
        let volume = |v: f64| Some(Size::MaxVolume(v));
        assert_eq!(sizes(&document), [volume(4.0), volume(0.1), volume(1e-3)]);
        parse(&["--region", "core:edge-length=0.5"])
            .unwrap()
            .apply(&mut document)
            .unwrap();
        assert_eq!(sizes(&document)[0], Some(Size::EdgeLength(0.5)));
        let unknown = parse(&["--region", "copper:max-volume=1"]).unwrap();
        let text = unknown.apply(&mut document).unwrap_err().to_string();
        assert!(
            text.contains("'copper'") && text.contains("'core' (3)"),
            "{text}"
        );
    }

    #[test]
    fn impossible_numbers_are_usage_errors() {
        for bad in [
            ["--radius-edge", "nan"],
            ["--radius-edge", "0.5"],
            ["--radius-edge", "-1"],
            ["--min-dihedral", "71"],
            ["--min-dihedral", "-1"],
            ["--max-volume", "0"],
            ["--max-volume", "inf"],
            ["--edge-length", "-2"],
            ["--optimize", "180"],
            ["--optimize", "on"],
            ["--region", "copper"],
            ["--region", ":max-volume=1"],
            ["--region", "copper:max-volume=x"],
            ["--region", "copper:edge-length=-1"],
            ["--region", "copper:length=1"],
            ["--layers-across", "0"],
            ["--layers-across", "2.5"],
            ["--layers-across", "1001"],
            ["--timeout", "0"],
        ] {
            let error = parse(&bad).unwrap_err();
            assert_eq!(error.exit_code(), 2, "{bad:?}");
        }
    }
}
