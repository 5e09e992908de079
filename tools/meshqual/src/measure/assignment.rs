//! `NAME=VALUE` on the command line.

/// The two sides of `NAME=VALUE`, the value finite; `form` is what an error says was expected.
pub fn metric_and_value<'t>(text: &'t str, form: &str) -> Result<(&'t str, f64), String> {
    let (name, value) = text
        .split_once('=')
        .ok_or_else(|| format!("expected {form}"))?;
    let number = value.trim().parse().ok();
    let number = number.filter(|v: &f64| v.is_finite());
    match number {
        Some(number) => Ok((name.trim(), number)),
        None => Err(format!("'{value}' is not a number")),
    }
}
