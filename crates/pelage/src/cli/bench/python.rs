//! Python packages that do the same as we do, where there are any.

use anyhow::{Context, Result, bail};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::io::Write;
use std::process::{Command, Stdio};

/// What the Python that `PELAGE_PYTHON` names prints as JSON, running `script` with
/// `question` as JSON on its standard input, all of which it has to read before it prints.
/// `None` where there is no such Python, or one without NumPy.
pub fn answer<T: DeserializeOwned>(script: &str, question: &impl Serialize) -> Result<Option<T>> {
    let Ok(python) = std::env::var("PELAGE_PYTHON") else {
        return Ok(None);
    };
    let run = |script: &str, input: &[u8]| {
        let mut running = Command::new(&python)
            .args(["-c", script])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()?;
        if let Some(mut stdin) = running.stdin.take() {
            // Ended early, it will have said why.
            let _ = stdin.write_all(input);
        }
        running.wait_with_output()
    };
    let cannot = || format!("cannot run {python}, which PELAGE_PYTHON names");
    if !run("import numpy", b"")
        .with_context(cannot)?
        .status
        .success()
    {
        return Ok(None);
    }
    let output = run(script, &serde_json::to_vec(question)?).with_context(cannot)?;
    if !output.status.success() {
        bail!(
            "the comparison with Python packages: {}",
            String::from_utf8_lossy(&output.stderr).trim()
        );
    }
    let found = serde_json::from_slice(&output.stdout);
    found.context("what the comparison in Python printed")
}
