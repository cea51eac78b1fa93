//! Every error state that is carried, by what is declared of it.

use super::Filter;
use crate::declaration::StateAxes;
use crate::error_state::declaration;

/// One component of an error state that is carried.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StateEstimate {
    /// Name of the block.
    pub name: &'static str,
    /// Which of its components, from 0.
    pub component: usize,
    /// Unit of value and sigma.
    pub unit: &'static str,
    /// Axes of the block.
    pub axes: StateAxes,
    /// What is estimated; `None` of the attitude, which is no vector.
    pub value: Option<f64>,
    /// 1-sigma of its error.
    pub sigma: f64,
}

impl Filter {
    /// All states that are carried, in their order, component by component.
    #[must_use]
    pub fn carried_states(&self) -> Vec<StateEstimate> {
        let (mut nominal, p) = (self.state.nominal, &self.state.covariance);
        let mut all = Vec::with_capacity(p.states());
        for place in p.layout().places() {
            let Some(declared) = declaration(place.key) else { continue };
            let values = declared.value(&mut nominal);
            all.extend((0..place.width).map(|component| {
                let at = place.start + component;
                StateEstimate {
                    name: declared.name,
                    component,
                    unit: declared.unit,
                    axes: declared.axes,
                    value: values.get(component).copied(),
                    sigma: p.matrix()[(at, at)].max(0.0).sqrt(),
                }
            }));
        }
        all
    }
}
