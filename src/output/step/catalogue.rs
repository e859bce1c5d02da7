//! Which parts share a product, after everything in them has been checked.

use std::collections::HashMap;

use super::body::Body;
use super::brep::{self, Solid};
use super::document::{Document, Group, Part};
use super::error::StepError;

/// The distinct products of a document.
pub(super) struct Catalogue<'d> {
    pub(super) products: Vec<Product<'d>>,
    /// Product of each part, in the order of the tree: parts of a group before
    /// those of the groups below it.
    pub(super) of_part: Vec<usize>,
    /// Largest distance of a coordinate from the origin, mm.
    pub(super) reach: f64,
}

/// One product: the first part that has it stands for all.
pub(super) struct Product<'d> {
    pub(super) part: &'d Part,
    pub(super) volume: f64,
    pub(super) solid: Solid,
}

/// Parts of one product agree in these; the rest is compared one by one.
type Key<'d> = (&'d str, [u8; 3]);

impl<'d> Catalogue<'d> {
    /// Checks all parts and finds the distinct ones among them.
    pub(super) fn of(document: &'d Document) -> Result<Self, StepError> {
        let mut catalogue = Self { products: Vec::new(), of_part: Vec::new(), reach: 0.0 };
        let mut alike: HashMap<Key<'d>, Vec<usize>> = HashMap::new();
        for group in &document.groups {
            catalogue.add_group(group, &mut alike)?;
        }
        if catalogue.of_part.is_empty() {
            return Err(StepError::Empty { document: document.name.clone() });
        }
        Ok(catalogue)
    }

    fn add_group(
        &mut self,
        group: &'d Group,
        alike: &mut HashMap<Key<'d>, Vec<usize>>,
    ) -> Result<(), StepError> {
        for part in &group.parts {
            self.add_part(part, alike)?;
        }
        group.groups.iter().try_for_each(|below| self.add_group(below, alike))
    }

    fn add_part(
        &mut self,
        part: &'d Part,
        alike: &mut HashMap<Key<'d>, Vec<usize>>,
    ) -> Result<(), StepError> {
        check_numbers(part)?;
        self.reach = self.reach.max(reach(&part.body) + part.placement.translation.vector.amax());
        let same = alike.entry((&part.product, part.colour)).or_default();
        let known = same.iter().copied().find(|&i| is_same_product(self.products[i].part, part));
        let product = match known {
            Some(product) => product,
            None => {
                let (volume, solid) = brep::build(&part.body)
                    .map_err(|fault| StepError::Body { part: part.name.clone(), fault })?;
                same.push(self.products.len());
                self.products.push(Product { part, volume, solid });
                self.products.len() - 1
            }
        };
        self.of_part.push(product);
        Ok(())
    }
}

fn is_same_product(a: &Part, b: &Part) -> bool {
    a.body == b.body && a.properties == b.properties
}

fn check_numbers(part: &Part) -> Result<(), StepError> {
    let fault = |what| Err(StepError::NotFinite { part: part.name.clone(), what });
    if !part.placement.to_homogeneous().iter().all(|x| x.is_finite()) {
        return fault("the placement");
    }
    let finite = |number: Option<f64>| number.is_none_or(f64::is_finite);
    if !part.properties.iter().all(|property| finite(property.value.number())) {
        return fault("a property");
    }
    Ok(())
}

/// Largest distance of a coordinate of the body from its origin, about.
fn reach(body: &Body) -> f64 {
    match body {
        Body::Sphere { radius } => *radius,
        Body::Facets(facets) => facets.reach(),
        Body::Loft(loft) => loft.stations.iter().map(|s| s.z.abs()).fold(0.0, f64::max),
    }
}
