//! What this tool is made of: a CycloneDX 1.5 bill of materials from its own lock file, which is compiled in.

use std::collections::{BTreeMap, BTreeSet};

use serde::Deserialize;
use serde_json::{Value, json};

use crate::evidence::digest::canonical;

/// Its path in a bundle.
pub const PATH: &str = "sbom.cdx.json";

const LOCK: &str = include_str!("../../../Cargo.lock");
const MANIFEST: &str = include_str!("../../../Cargo.toml");

#[derive(Deserialize)]
struct Lock {
    package: Vec<Package>,
}

#[derive(Clone, Deserialize)]
struct Package {
    name: String,
    version: String,
    checksum: Option<String>,
    source: Option<String>,
    #[serde(default)]
    dependencies: Vec<String>,
}

impl Package {
    fn reference(&self) -> String {
        format!("pkg:cargo/{}@{}", self.name, self.version)
    }
}

/// The bill, canonical JSON; the dependencies of tests and benches are left out.
///
/// # Errors
/// If the compiled-in lock file cannot be read, which a test excludes.
pub fn sbom() -> Result<Vec<u8>, String> {
    let lock: Lock = toml::from_str(LOCK).map_err(|error| error.to_string())?;
    let manifest: toml::Table = toml::from_str(MANIFEST).map_err(|error| error.to_string())?;
    let direct = manifest.get("dependencies").and_then(toml::Value::as_table).ok_or("no dependencies")?;
    let packages: BTreeMap<String, &Package> =
        lock.package.iter().map(|package| (package.reference(), package)).collect();
    let find = |dependency: &str| -> Option<String> {
        let mut words = dependency.split(' ');
        let (name, version) = (words.next()?, words.next());
        let same =
            |package: &&Package| package.name == name && version.is_none_or(|version| package.version == version);
        lock.package.iter().find(same).map(Package::reference)
    };
    let root =
        lock.package.iter().find(|package| package.name == env!("CARGO_PKG_NAME")).ok_or("not in its lock file")?;
    let name = |dependency: &str| dependency.split(' ').next().unwrap_or("").to_owned();
    let own = root.dependencies.iter().filter(|dependency| direct.contains_key(&name(dependency)));
    let first: BTreeSet<String> = own.filter_map(|dependency| find(dependency)).collect();
    let mut seen = first.clone();
    let mut open: Vec<String> = first.iter().cloned().collect();
    let mut edges: BTreeMap<String, BTreeSet<String>> = [(root.reference(), first)].into();
    while let Some(reference) = open.pop() {
        let Some(package) = packages.get(&reference) else { continue };
        let next: BTreeSet<String> = package.dependencies.iter().filter_map(|dependency| find(dependency)).collect();
        open.extend(next.iter().filter(|next| seen.insert((*next).clone())).cloned());
        edges.insert(reference, next);
    }
    let components: Vec<Value> =
        seen.iter().filter_map(|reference| packages.get(reference)).map(|p| component(p)).collect();
    let graph: Vec<Value> = edges.iter().map(|(reference, on)| json!({"ref": reference, "dependsOn": on})).collect();
    Ok(canonical(&json!({
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "version": 1,
        "metadata": {"component": {
            "type": "application",
            "bom-ref": root.reference(),
            "name": root.name,
            "version": root.version,
            "purl": root.reference(),
        }},
        "components": components,
        "dependencies": graph,
    })))
}

fn component(package: &Package) -> Value {
    let reference = package.reference();
    let mut value = json!({
        "type": "library",
        "bom-ref": reference,
        "name": package.name,
        "version": package.version,
        "purl": reference,
    });
    if let Some(checksum) = &package.checksum {
        value["hashes"] = json!([{"alg": "SHA-256", "content": checksum}]);
    }
    if let Some(source) = package.source.as_deref().and_then(|source| source.strip_prefix("registry+")) {
        value["externalReferences"] = json!([{"type": "distribution", "url": source}]);
    }
    value
}
