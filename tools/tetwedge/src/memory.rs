//! The limit of memory on the command line.

use mesher::Params;
use tmesh::Wishes;

/// What tools that run the mesher are told about it besides wishes.
#[derive(clap::Args, Clone, Debug)]
pub struct MemoryArgs {
    /// Memory that the mesher may take, per template, in MiB or with a unit: 512M, 8G [default: none]
    #[arg(long, value_name = "SIZE", value_parser = memory)]
    max_memory: Option<u64>,
}

impl MemoryArgs {
    /// A document's wishes within this limit.
    pub fn params(&self, wishes: &Wishes) -> Params {
        Params {
            max_memory: self.max_memory,
            ..Params::new(wishes)
        }
    }
}

/// Bytes in a size such as `512M`, `1.5G`, or `512` for MiB.
fn memory(text: &str) -> Result<u64, String> {
    let (digits, unit) = match text.to_ascii_uppercase().chars().last() {
        Some('M') => (&text[..text.len() - 1], 20),
        Some('G') => (&text[..text.len() - 1], 30),
        _ => (text, 20),
    };
    let number: f64 = digits.parse().map_err(|_| "not a number".to_owned())?;
    let bytes = (number * f64::from(1 << unit)).ceil();
    // Conversion keeps to the range, NaN becomes 0.
    match bytes as u64 {
        0 => Err("must be above 0".to_owned()),
        u64::MAX => Err("more than there is anywhere".to_owned()),
        bytes => Ok(bytes),
    }
}
