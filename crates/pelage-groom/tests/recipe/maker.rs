//! Recipes made at random from the JSON Schema, so that a new key takes part in
//! the tests by being declared.

use serde_json::{Map, Value, json};

/// File names that need quotes, escapes and more than ASCII.
const FILES: [&str; 6] = [
    "map.png",
    "map.<UDIM>.png",
    "a b.exr",
    "ä/日本.tif",
    "quo\"te'.png",
    "back\\slash.hdr",
];

/// Makes values that a schema allows.
pub struct Maker<'s> {
    root: &'s Value,
    state: u64,
}

impl<'s> Maker<'s> {
    /// A maker of what `root` allows; equal seeds make equal values.
    pub fn new(root: &'s Value, seed: u64) -> Self {
        Self { root, state: seed }
    }

    /// A recipe.
    pub fn recipe(&mut self) -> Value {
        let mut recipe = self.value(self.root);
        let guides = recipe["guides"].as_object_mut().unwrap();
        if guides.contains_key("curves") {
            guides.remove("grow");
        } else if guides.contains_key("grow") {
            guides.remove("tolerance");
            guides.remove("posed");
        } else {
            guides.insert("curves".into(), json!("guides.usda"));
        }
        if let Some(grow) = guides.get_mut("grow").and_then(Value::as_object_mut) {
            grow.remove(["curl", "bend"][self.below(2) as usize]);
        }
        if let Some(groups) = recipe.get_mut("groups").and_then(Value::as_object_mut)
            && !groups.contains_key("map")
        {
            groups.remove("segments");
        }
        let levels = recipe.pointer_mut("/clump/levels");
        for level in levels.and_then(Value::as_array_mut).into_iter().flatten() {
            let level = level.as_object_mut().unwrap();
            let around = level
                .get("around")
                .and_then(Value::as_str)
                .unwrap_or("points");
            let (size, map) = (around == "points", around == "map");
            level.retain(|name, _| (map || name != "map") && (size || name != "size"));
            if size {
                level.insert("size".into(), json!(0.25));
            }
            if map {
                level.insert("map".into(), json!(FILES[0]));
            }
        }
        recipe
    }

    /// The next number (SplitMix64) below `end`.
    fn below(&mut self, end: u64) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) % end
    }

    fn pick<'v>(&mut self, values: &'v [Value]) -> &'v Value {
        &values[self.below(values.len() as u64) as usize]
    }

    fn value(&mut self, schema: &Value) -> Value {
        if let Some(reference) = schema["$ref"].as_str() {
            return self.value(self.root.pointer(&reference[1..]).unwrap());
        }
        if let Some(choices) = schema["anyOf"].as_array() {
            let choice = self.pick(choices).clone();
            return self.value(&choice);
        }
        if let Some(words) = schema["enum"].as_array() {
            return self.pick(words).clone();
        }
        match schema["type"].as_str().unwrap() {
            "boolean" => json!(self.below(2) == 1),
            "integer" => self.whole(schema),
            "number" => self.number(schema),
            "string" if schema["pattern"].is_string() => json!(self.color()),
            "string" => json!(FILES[self.below(FILES.len() as u64) as usize]),
            "array" => self.list(schema),
            _ => Value::Object(self.table(schema)),
        }
    }

    fn color(&mut self) -> String {
        format!("#{:06x}", self.below(1 << 24))
    }

    fn whole(&mut self, schema: &Value) -> Value {
        let min = schema["minimum"].as_u64().unwrap_or(0);
        let max = schema["maximum"].as_u64().unwrap_or(1 << 20);
        let end = [10, 1000, u64::MAX][self.below(3) as usize];
        json!(min + self.below((max - min).min(end)))
    }

    fn number(&mut self, schema: &Value) -> Value {
        let share = self.below(1 << 20) as f64 / (1 << 20) as f64;
        let limit = |name: &str| schema[name].as_f64();
        let max = limit("maximum").unwrap_or([1.0, 1e3, 1e-9, 1e30][self.below(4) as usize]);
        match (limit("minimum"), limit("exclusiveMinimum")) {
            (Some(min), _) => json!(min + (max - min).abs() * share),
            // An f64, which serde_json keeps to the last bit where it is short.
            (None, Some(min)) => json!(min + (1 + self.below(999)) as f64 / 1000.0),
            (None, None) => json!(max * (2.0 * share - 1.0)),
        }
    }

    fn list(&mut self, schema: &Value) -> Value {
        let least = schema["minItems"].as_u64().unwrap_or(0);
        let most = schema["maxItems"].as_u64().unwrap_or(least + 3);
        let count = least + self.below(most - least + 1);
        let items = &schema["items"];
        let item = |i: u64, maker: &mut Self| match items["prefixItems"].as_array() {
            // Points of a ramp ascend.
            Some(parts) => json!([i as f64 / count as f64, maker.value(&parts[1])]),
            None => maker.value(items),
        };
        (0..count).map(|i| item(i, self)).collect()
    }

    fn table(&mut self, schema: &Value) -> Map<String, Value> {
        let mut table = Map::new();
        if let Some(patterns) = schema["patternProperties"].as_object() {
            for number in patterns.values() {
                table.insert(self.color(), self.value(number));
            }
            return table;
        }
        let keys = schema["properties"].as_object().unwrap();
        let required = schema["required"].as_array();
        for (name, key) in keys {
            let must = required.is_some_and(|names| names.contains(&json!(name)));
            if must || self.below(2) == 0 {
                table.insert(name.clone(), self.value(key));
            }
        }
        if keys.contains_key("map") && keys.contains_key("wrap") {
            self.agree(&mut table, keys);
        }
        if table
            .get("root")
            .is_some_and(|root| !root["ramp"].is_null())
        {
            table.retain(|name, _| name != "tip" && name != "center");
        }
        table
    }

    /// What the schema leaves to the reader in the table of a property: how
    /// its keys go together.
    fn agree(&mut self, table: &mut Map<String, Value>, keys: &Map<String, Value>) {
        if !table.contains_key("map") {
            table.retain(|name, _| name == "value" || name == "ramp");
        }
        if table.get("map").is_some_and(|map| map == FILES[1]) {
            table.remove("wrap");
        }
        if table.contains_key("ramp") {
            table.remove("value");
        }
        if table.is_empty() {
            table.insert("value".into(), self.value(&keys["value"]));
        }
    }
}
