//! The model at given values of the parameters, for other methods of fitting than that of this
//! crate.

use interp::Table;

use super::{Bodies, Branch, Experiment, Kind, Parameter};
use crate::Error;

/// The ordinates that the values of an experiment give at its points.
#[derive(Clone, Debug, PartialEq)]
pub struct Prediction {
    /// The ordinate of each point, N or m; NaN for a point that is left out.
    pub ordinates: Vec<f64>,
    /// The contact radius of each point, m; 0 without a contact, NaN for a point that is left out.
    pub contact_radii: Vec<f64>,
    /// The branch of each point, [`Branch::Pinned`] where the values leave the line at rest after the turn.
    pub branches: Vec<Branch>,
    /// Whether each point is in contact according to its branch, but beyond the end of the stable
    /// states. There the branch is continued by a straight line, so that a sum of squares has no
    /// jump.
    pub beyond: Vec<bool>,
    /// The derivatives of the ordinates with respect to each parameter asked for, in SI units,
    /// point after point; NaN for a point that is left out.
    pub derivatives: Vec<f64>,
}

impl Experiment {
    /// Reads from the data on which branch each point is, as [`fit`](crate::fit) does before it
    /// fits the parameters `free`.
    ///
    /// # Errors
    /// [`Error::Point`] for a point that is not finite, too large, or at a radius that is negative
    /// or not below that of the sphere; [`Error::Constant`] for points that are all at one place or
    /// all read one value.
    pub fn branches(&self, free: &[Parameter]) -> Result<Vec<Branch>, Error> {
        let (branches, ..) = self.assign(|parameter| free.contains(&parameter))?;
        Ok(branches)
    }

    /// Evaluates the model at every point, with the derivatives with respect to `parameters` at a
    /// fixed abscissa. They are exact; on a stack of layers, of contact stiffnesses and beyond the
    /// nodes of the table in `a/t` they are central differences, on a stack with errors of at most
    /// 1e-5 of the largest.
    ///
    /// `branches` holds the branch of each point; `None` takes those on which the model itself has
    /// the points, as [`simulate`](crate::simulate) does. The ordinates of the points are not used.
    ///
    /// # Errors
    /// [`Error::Point`] for an abscissa that is not finite; [`Error::Setting`] for another number
    /// of branches than points, a zero of the instrument that is not finite, or a missing
    /// stiffness;
    /// [`Error::NotFitted`] for a parameter without an effect on this experiment;
    /// [`Error::Contact`] outside the table.
    pub fn predictions(
        &self,
        table: &Table,
        branches: Option<&[Branch]>,
        parameters: &[Parameter],
    ) -> Result<Prediction, Error> {
        self.accept_instrument()?;
        self.accept_indentation()?;
        self.accept_abscissae()?;
        for &parameter in parameters {
            if let Some(reason) = self.why_without_effect(parameter) {
                return Err(self.not_applicable(parameter, reason));
            }
        }
        let count = self.measurement.points.len();
        if self.measurement.kind == Kind::StiffnessDepth {
            // The measured stiffness tells the contact depth.
            self.accept_stiffness()?;
        }
        let contact = self.bodies.contact(table, parameters)?;
        let contact_of = |bodies: &Bodies, by: &[Parameter]| {
            if bodies == &self.bodies {
                Ok(contact.clone())
            } else {
                bodies.contact(table, by)
            }
        };
        let (of_model, order) = self.branches_of_model(&contact)?;
        let branches = branches.map_or(of_model, <[Branch]>::to_vec);
        if branches.len() != count {
            let (found, allowed) = (branches.len(), format!("that of the points, {count}"));
            return Err(Error::setting("number of branches", found as f64, allowed));
        }
        let mut branches: Vec<Branch> = branches.iter().map(|one| one.of_contact()).collect();
        let mut predicted = self.predict_with(&contact_of, &branches, &order, parameters)?;
        if self.measurement.kind.is_stiffness() {
            let width = parameters.len();
            for (i, value) in predicted.values.iter_mut().enumerate() {
                *value = self.ordinate_of(*value);
                for by in &mut predicted.derivatives[i * width..][..width] {
                    *by *= *value;
                }
            }
        }
        for (i, branch) in branches.iter_mut().enumerate() {
            *branch = predicted.branch(i, *branch);
        }
        let kept = |i: usize, value: f64| {
            if branches[i] == Branch::LeftOut {
                f64::NAN
            } else {
                value
            }
        };
        let column = |values: Vec<f64>, width: usize| {
            let values = values.into_iter().enumerate();
            values.map(|(i, value)| kept(i / width, value)).collect()
        };
        Ok(Prediction {
            ordinates: column(predicted.values, 1),
            contact_radii: column(predicted.radii, 1),
            derivatives: column(predicted.derivatives, parameters.len().max(1)),
            beyond: predicted.beyond,
            branches,
        })
    }
}
