//! Checks how layers refer to each other before `openusd` composes them.
//!
//! Composition follows references, payloads, inherits and specializes by calling
//! itself. Arcs that close a circle through children (`/a` has a child that
//! inherits `/a`) end the process there, and arcs to arcs can multiply without
//! end. So the arcs are followed here first, on the specs as they are written.

use super::clips;
use super::cursor::Broken;
use super::names;
use super::resolver::{Files, load};
use openusd::ar::ResolvedPath;
use openusd::{sdf, usdc};
use std::collections::{BTreeSet, HashMap};
use std::io::Cursor;

/// Arcs and levels of prims followed in a row.
const MAX_DEPTH: usize = 100;

/// Composed sites of all prims together.
const MAX_SITES: u64 = 500_000;

/// A layer with its sublayers: what an arc can point into.
#[derive(Default)]
struct Unit {
    /// Path of the prim that arcs without a path mean.
    default: Option<String>,
    arcs: HashMap<String, Vec<Target>>,
    children: HashMap<String, BTreeSet<String>>,
}

/// Where an arc points: a unit and a prim path in it, which starts with
/// [`DEFAULT`] where it is that of the default prim.
#[derive(Clone)]
struct Target {
    unit: usize,
    path: String,
}

/// Stands for the path of the default prim, whose layer may not be loaded yet.
const DEFAULT: char = '~';

/// Fails where composing the layer `root` (of contents `bytes`) would not end.
pub(super) fn check(root: &ResolvedPath, bytes: &[u8]) -> Result<(), Broken> {
    if !may_refer(bytes) {
        return Ok(());
    }
    let mut graph = Graph::default();
    let unit = graph.unit(root);
    let mut walk = Walk {
        graph: &mut graph,
        counts: HashMap::new(),
        open: BTreeSet::new(),
    };
    let sites = walk.sites(unit, "/", false, 0)?;
    match sites <= MAX_SITES {
        true => Ok(()),
        false => Err(Broken(format!(
            "its references multiply to more than {MAX_SITES} prims"
        ))),
    }
}

/// Whether a layer can have arcs, clips or variants at all; text without these words cannot.
fn may_refer(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return true;
    };
    let words = [
        "references",
        "payload",
        "inherits",
        "specializes",
        "subLayers",
        "clips",
        "relocates",
        "variant",
    ];
    words.iter().any(|word| text.contains(word)) || bytes.starts_with(usdc::MAGIC)
}

/// Units by number, loaded when an arc first points into them.
#[derive(Default)]
struct Graph {
    files: Files,
    places: Vec<ResolvedPath>,
    units: Vec<Option<Unit>>,
}

impl Graph {
    /// Number of the unit whose root layer is at `place`.
    fn unit(&mut self, place: &ResolvedPath) -> usize {
        let known = self.places.iter().position(|p| p == place);
        known.unwrap_or_else(|| {
            self.places.push(place.clone());
            self.units.push(None);
            self.places.len() - 1
        })
    }

    /// The unit, loaded. Layers that cannot be read have nothing in them: composing
    /// the stage will say so.
    fn loaded(&mut self, unit: usize) -> Result<&Unit, Broken> {
        if self.units[unit].is_none() {
            let mut all = Unit::default();
            let mut seen = BTreeSet::new();
            let root = self.places[unit].clone();
            let mut pending = vec![root];
            while let Some(place) = pending.pop() {
                if seen.insert(place.to_path_buf()) {
                    pending.extend(self.add_layer(&mut all, unit, &place)?);
                }
            }
            self.units[unit] = Some(all);
        }
        Ok(self.units[unit].get_or_insert_default())
    }

    /// Adds the specs of one layer to `all`; gives its sublayers.
    fn add_layer(
        &mut self,
        all: &mut Unit,
        unit: usize,
        place: &ResolvedPath,
    ) -> Result<Vec<ResolvedPath>, Broken> {
        let Some(layer) = load(place).ok().and_then(parse) else {
            return Ok(Vec::new());
        };
        for path in layer.spec_paths() {
            // As if every variant were chosen: arcs name prims without their variants.
            let prim = path.strip_all_variant_selections();
            if prim.is_abs_root() || prim.as_str().contains(['.', '[']) {
                continue;
            }
            if !names::is_prim_path(prim.as_str()) {
                return Err(Broken(format!("{path} is no path of a prim")));
            }
            let parent = prim.parent().unwrap_or_else(sdf::Path::abs_root);
            let siblings = all.children.entry(parent.to_string()).or_default();
            siblings.insert(prim.to_string());
            check_fields(layer.as_ref(), &path)?;
            let targets = self.targets(layer.as_ref(), &path, unit, place)?;
            if !targets.is_empty() {
                all.arcs
                    .entry(prim.to_string())
                    .or_default()
                    .extend(targets);
            }
        }
        let root = sdf::Path::abs_root();
        check_fields(layer.as_ref(), &root)?;
        let default = layer.try_field(&root, "defaultPrim").ok().flatten();
        let default = default.and_then(|value| value.into_owned().try_as_token());
        if place == &self.places[unit] {
            let path = default.map(|name| format!("/{}", name.trim_start_matches('/')));
            all.default = path;
        }
        self.sublayers(layer.as_ref(), place)
    }

    /// Where the sublayers of the layer at `place` are, those that are there.
    fn sublayers(
        &self,
        layer: &dyn sdf::AbstractData,
        place: &ResolvedPath,
    ) -> Result<Vec<ResolvedPath>, Broken> {
        let value = layer.try_field(&sdf::Path::abs_root(), "subLayers");
        let assets = match value.ok().flatten().map(|value| value.into_owned()) {
            Some(sdf::Value::StringVec(v)) => v,
            Some(sdf::Value::AssetPathVec(v)) => v.iter().map(|p| p.to_string()).collect(),
            _ => Vec::new(),
        };
        let found = assets.iter().map(|asset| self.resolve(asset, place));
        found.filter_map(Result::transpose).collect()
    }

    fn resolve(&self, asset: &str, from: &ResolvedPath) -> Result<Option<ResolvedPath>, Broken> {
        if asset.contains('`') {
            return Err(Broken(format!(
                "the asset path {asset} is an expression, which is not followed"
            )));
        }
        let identifier = self.files.identifier(asset, Some(from));
        Ok(self.files.resolve(&identifier))
    }

    /// Where the arcs of one spec point.
    fn targets(
        &mut self,
        layer: &dyn sdf::AbstractData,
        path: &sdf::Path,
        unit: usize,
        place: &ResolvedPath,
    ) -> Result<Vec<Target>, Broken> {
        let field = |name| {
            let value = layer.try_field(path, name).ok().flatten();
            value.map(|value| value.into_owned())
        };
        let mut arcs: Vec<(String, sdf::Path)> = Vec::new();
        if let Some(sdf::Value::ReferenceListOp(list)) = field("references") {
            arcs.extend(items(&list).map(|r| (r.asset_path.clone(), r.prim_path.clone())));
        }
        match field("payload") {
            Some(sdf::Value::PayloadListOp(list)) => {
                arcs.extend(items(&list).map(|p| (p.asset_path.clone(), p.prim_path.clone())));
            }
            Some(sdf::Value::Payload(p)) => arcs.push((p.asset_path, p.prim_path)),
            _ => {}
        }
        let mut targets = Vec::new();
        for (asset, prim) in arcs {
            let target = match asset.is_empty() {
                true => Some(unit),
                false => self.resolve(&asset, place)?.map(|place| self.unit(&place)),
            };
            let path = match prim.is_empty() {
                true => DEFAULT.to_string(),
                false => target_path(path, &prim)?,
            };
            targets.extend(target.map(|unit| Target { unit, path }));
        }
        for name in ["inheritPaths", "specializes"] {
            if let Some(sdf::Value::PathListOp(list)) = field(name) {
                for class in items(&list) {
                    let path = target_path(path, &path.make_absolute(class))?;
                    // The root layer's prim of that path is inherited as well.
                    let units = BTreeSet::from([0, unit]);
                    targets.extend(units.into_iter().map(|unit| Target {
                        unit,
                        path: path.clone(),
                    }));
                }
            }
        }
        Ok(targets)
    }
}

/// Fails where a field of the prim or variant at `path` puts names into paths that they
/// cannot hold, or lists value clips without end.
fn check_fields(layer: &dyn sdf::AbstractData, path: &sdf::Path) -> Result<(), Broken> {
    let fields = layer.list_fields(path).unwrap_or_default();
    for name in fields.iter().filter(|name| names::in_paths(name)) {
        let Some(value) = layer.try_field(path, name).ok().flatten() else {
            continue;
        };
        if name == "clips" {
            clips::check(path, &value)?;
        } else if let Some(wrong) = names::wrong(name, &value) {
            let wrong: String = wrong.chars().take(40).collect();
            return Err(Broken(format!("{name} of {path} cannot name {wrong:?}")));
        }
    }
    Ok(())
}

/// The path of the prim that an arc from `from` points to.
fn target_path(from: &sdf::Path, target: &sdf::Path) -> Result<String, Broken> {
    let plain = target.strip_all_variant_selections().to_string();
    match names::is_prim_path(&plain) {
        true => Ok(plain),
        false => Err(Broken(format!(
            "{from} refers to <{target}>, which is no path of a prim"
        ))),
    }
}

/// What a list operation may leave in the list.
fn items<T: Default + Clone + PartialEq>(list: &sdf::ListOp<T>) -> impl Iterator<Item = &T> {
    let added = list.explicit_items.iter().chain(&list.added_items);
    added
        .chain(&list.prepended_items)
        .chain(&list.appended_items)
}

fn parse(bytes: Vec<u8>) -> Option<sdf::LayerData> {
    if bytes.starts_with(usdc::MAGIC) {
        let data = usdc::CrateData::open(Cursor::new(bytes), true).ok()?;
        return Some(Box::new(data));
    }
    let text = String::from_utf8(bytes).ok()?;
    Some(Box::new(openusd::usda::parse(&text).ok()?))
}

/// Follows arcs and children depth first.
struct Walk<'a> {
    graph: &'a mut Graph,
    counts: HashMap<(usize, String, bool), u64>,
    /// Sites that are being followed.
    open: BTreeSet<(usize, String)>,
}

impl Walk<'_> {
    /// Sites below and behind a prim. An arc that points to it brings what arcs of
    /// its ancestors bring to it, too (`is_target`).
    fn sites(
        &mut self,
        unit: usize,
        path: &str,
        is_target: bool,
        depth: usize,
    ) -> Result<u64, Broken> {
        let path = match path.strip_prefix(DEFAULT) {
            None => path.to_owned(),
            Some(rest) => match &self.graph.loaded(unit)?.default {
                Some(default) => format!("{default}{rest}"),
                None => return Ok(1),
            },
        };
        let path = path.as_str();
        let key = (unit, path.to_owned(), is_target);
        if let Some(&count) = self.counts.get(&key) {
            return Ok(count);
        }
        if depth > MAX_DEPTH {
            return Err(Broken(format!(
                "its references and prims nest deeper than {MAX_DEPTH} at {path}"
            )));
        }
        if !self.open.insert((unit, path.to_owned())) {
            return Err(Broken(format!("its references form a circle at {path}")));
        }
        let loaded = self.graph.loaded(unit)?;
        let mut next = loaded.arcs.get(path).cloned().unwrap_or_default();
        let ancestors = path.match_indices('/').map(|(at, _)| path.split_at(at));
        for (ancestor, suffix) in ancestors.filter(|(a, _)| is_target && !a.is_empty()) {
            for target in loaded.arcs.get(ancestor).into_iter().flatten() {
                let base = target.path.trim_end_matches('/');
                next.push(Target {
                    unit: target.unit,
                    path: format!("{base}{suffix}"),
                });
            }
        }
        let children = loaded.children.get(path).cloned().unwrap_or_default();
        let mut count = 1u64;
        for target in next {
            let sites = self.sites(target.unit, &target.path, true, depth + 1)?;
            count = count.saturating_add(sites);
        }
        for child in children {
            let sites = self.sites(unit, &child, false, depth + 1)?;
            count = count.saturating_add(sites);
        }
        self.open.remove(&(unit, path.to_owned()));
        self.counts.insert(key, count);
        Ok(count)
    }
}
