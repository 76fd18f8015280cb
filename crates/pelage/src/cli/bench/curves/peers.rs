//! The same spline by Python packages, where there are any.

use anyhow::{Context, Result, bail};
use std::collections::BTreeMap;
use std::process::{Command, Stdio};

const SCRIPT: &str = include_str!("peers.py");

/// Millions of points a second, with three derivatives, by the package. Empty where
/// `PELAGE_PYTHON` names no Python, or one without NumPy.
pub fn measure() -> Result<BTreeMap<String, f64>> {
    let Ok(python) = std::env::var("PELAGE_PYTHON") else {
        return Ok(BTreeMap::new());
    };
    let cannot = || format!("cannot run {python}, which PELAGE_PYTHON names");
    let run = |script: &str| {
        let mut command = Command::new(&python);
        command.args(["-c", script]).stdin(Stdio::null());
        command.output().with_context(cannot)
    };
    if !run("import numpy")?.status.success() {
        return Ok(BTreeMap::new());
    }
    let output = run(SCRIPT)?;
    if !output.status.success() {
        bail!(
            "the comparison with Python packages: {}",
            String::from_utf8_lossy(&output.stderr).trim()
        );
    }
    serde_json::from_slice(&output.stdout).context("what the comparison in Python printed")
}
