//! Skeletons as written, and whether two of them are the same curves.

use std::collections::HashMap;
use std::path::Path;

use serde_json::Value;

/// What a skeleton file holds.
#[derive(Clone, Debug)]
pub struct Curves {
    pub points: Vec<[f64; 3]>,
    pub kinds: Vec<String>,
    pub radii: Vec<f64>,
    pub branches: Vec<Vec<usize>>,
}

impl Curves {
    /// Reads a skeleton file of the program's own format.
    pub fn read(path: &Path) -> Self {
        let text = std::fs::read_to_string(path).expect("a skeleton file");
        let file: Value = serde_json::from_str(&text).expect("JSON");
        let list = |value: &Value| value.as_array().expect("a list").clone();
        let number = |value: &Value| value.as_f64().expect("a number");
        let points = list(&file["points"]);
        let index: HashMap<u64, usize> =
            points.iter().enumerate().map(|(i, p)| (p["id"].as_u64().expect("an id"), i)).collect();
        Self {
            points: points.iter().map(|p| [0, 1, 2].map(|k| number(&p["position"][k]))).collect(),
            kinds: points.iter().map(|p| p["kind"].as_str().expect("a kind").to_owned()).collect(),
            radii: points.iter().map(|p| number(&p["radius"])).collect(),
            branches: list(&file["branches"])
                .iter()
                .map(|b| list(&b["points"]).iter().map(|i| index[&i.as_u64().unwrap()]).collect())
                .collect(),
        }
    }

    /// The same curves with every point mapped.
    pub fn mapped(mut self, map: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        self.points.iter_mut().for_each(|p| *p = map(*p));
        self
    }

    /// Largest distance of a point from its counterpart in other curves.
    ///
    /// # Errors
    /// How the topology differs: counts, kinds, or what a branch joins.
    pub fn deviation_from(&self, other: &Self) -> Result<f64, String> {
        let counts = |c: &Self| (c.points.len(), c.branches.len());
        if counts(self) != counts(other) {
            return Err(format!("(points, branches): {:?}, {:?}", counts(self), counts(other)));
        }
        let counterpart: Vec<usize> = self.points.iter().map(|&p| other.nearest(p)).collect();
        let mut is_met = vec![false; other.points.len()];
        counterpart.iter().for_each(|&i| is_met[i] = true);
        if let Some(i) = is_met.iter().position(|met| !met) {
            return Err(format!("nothing at {:?}", other.points[i]));
        }
        if let Some(i) =
            (0..self.points.len()).find(|&i| self.kinds[i] != other.kinds[counterpart[i]])
        {
            return Err(format!("another kind at {:?}", self.points[i]));
        }
        let mapped = self.branches.iter().map(|b| b.iter().map(|&i| counterpart[i]).collect());
        if sorted(mapped) != sorted(other.branches.iter().cloned()) {
            return Err("branches run differently".to_owned());
        }
        let pairs = self.points.iter().zip(&counterpart);
        Ok(pairs.map(|(&p, &i)| distance(p, other.points[i])).fold(0.0, f64::max))
    }

    fn nearest(&self, place: [f64; 3]) -> usize {
        let to = |i: &usize| distance(place, self.points[*i]);
        (0..self.points.len()).min_by(|a, b| to(a).total_cmp(&to(b))).expect("a point")
    }
}

/// Branches, each run from its lower end, in order.
fn sorted(branches: impl Iterator<Item = Vec<usize>>) -> Vec<Vec<usize>> {
    let mut all: Vec<Vec<usize>> = branches
        .map(|branch| {
            let reversed: Vec<usize> = branch.iter().rev().copied().collect();
            branch.min(reversed)
        })
        .collect();
    all.sort();
    all
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    [0, 1, 2].map(|k| (a[k] - b[k]).powi(2)).iter().sum::<f64>().sqrt()
}
