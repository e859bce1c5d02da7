//! The tree: groups as assemblies, parts placed in them.

use nalgebra::{Isometry3, Vector3};

use super::brep::Axes;
use super::catalogue::Catalogue;
use super::document::{Document, Group};
use super::error::StepError;
use super::product::{Placed, Products};
use crate::output::part21::{Fault, Id, Text};

/// Writes all products, then the tree from its leaves to its root.
pub(super) fn write_tree(
    document: &Document,
    catalogue: &Catalogue<'_>,
    products: Products<'_, '_>,
) -> Result<(), StepError> {
    let mut tree = Tree { products, occurrences: 0, next_part: 0, catalogue, written: Vec::new() };
    for product in &catalogue.products {
        let placed = tree.products.leaf(product);
        let placed = placed.map_err(|fault| fault.of(product.part.name.clone()))?;
        tree.written.push(placed);
    }
    tree.root(document).map_err(|fault| fault.of(document.name.clone()))
}

impl Fault {
    /// The fault as an error of a part.
    pub(super) fn of(self, part: String) -> StepError {
        match self {
            Self::NotFinite => StepError::NotFinite { part, what: "a computed measure" },
            Self::Io(error) => StepError::Io(error),
        }
    }
}

/// A component of an assembly: what, where, and under which name.
struct Component<'n> {
    name: &'n str,
    placed: Placed,
    /// `None` at the origin.
    placement: Option<Id>,
}

struct Tree<'c, 'd, 'w, 'a> {
    products: Products<'w, 'a>,
    catalogue: &'c Catalogue<'d>,
    written: Vec<Placed>,
    next_part: usize,
    occurrences: usize,
}

impl Tree<'_, '_, '_, '_> {
    fn root(mut self, document: &Document) -> Result<(), Fault> {
        let mut components = Vec::new();
        for group in &document.groups {
            components.extend(self.group(group)?);
        }
        self.assembly(&document.name, &components)?;
        self.products.finish()
    }

    /// Writes a group and what is below it, if there is a part in it.
    fn group<'n>(&mut self, group: &'n Group) -> Result<Option<Component<'n>>, Fault> {
        let mut components = Vec::with_capacity(group.parts.len() + group.groups.len());
        let placements = self.placements(group)?;
        for (part, placement) in group.parts.iter().zip(placements) {
            let product = self.catalogue.of_part[self.next_part];
            self.next_part += 1;
            let name = if part.name.is_empty() { &part.product } else { &part.name };
            let placed = self.written[product];
            components.push(Component { name, placed, placement: Some(placement) });
        }
        for below in &group.groups {
            components.extend(self.group(below)?);
        }
        if components.is_empty() {
            return Ok(None);
        }
        let placed = self.assembly(&group.name, &components)?;
        Ok(Some(Component { name: &group.name, placed, placement: None }))
    }

    fn placements(&mut self, group: &Group) -> Result<Vec<Id>, Fault> {
        let geometry = &mut self.products.geometry;
        group.parts.iter().map(|part| geometry.placement(&axes(&part.placement))).collect()
    }

    fn assembly(&mut self, name: &str, components: &[Component<'_>]) -> Result<Placed, Fault> {
        let placements: Vec<Id> = components.iter().filter_map(|c| c.placement).collect();
        let assembly = self.products.assembly(name, &placements)?;
        components.iter().try_for_each(|component| self.place(component, assembly))?;
        Ok(assembly)
    }

    /// Places a component in an assembly.
    fn place(&mut self, component: &Component<'_>, assembly: Placed) -> Result<(), Fault> {
        self.occurrences += 1;
        let (number, name) = (self.occurrences, Text(component.name));
        let (whole, child) = (assembly.definition, component.placed.definition);
        let origin = self.products.origin;
        let target = component.placement.unwrap_or(origin);
        let part = self.products.part();
        let usage = part.entity(format_args!(
            "NEXT_ASSEMBLY_USAGE_OCCURRENCE('{number}',{name},'',{whole},{child},$)"
        ))?;
        let place = part.entity(format_args!("PRODUCT_DEFINITION_SHAPE('','',{usage})"))?;
        let transform =
            part.entity(format_args!("ITEM_DEFINED_TRANSFORMATION('','',{origin},{target})"))?;
        let (from, to) = (component.placed.shape, assembly.shape);
        let relation = part.entity(format_args!(
            "(REPRESENTATION_RELATIONSHIP('','',{from},{to})\
             REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION({transform})\
             SHAPE_REPRESENTATION_RELATIONSHIP())"
        ))?;
        part.entity(format_args!("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION({relation},{place})"))?;
        Ok(())
    }
}

/// Where a placement brings the origin, z and x.
fn axes(placement: &Isometry3<f64>) -> Axes {
    let origin = placement.translation.vector.into();
    Axes::about(origin, placement * Vector3::z(), placement * Vector3::x())
}
