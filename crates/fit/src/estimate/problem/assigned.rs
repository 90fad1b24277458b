//! An experiment as a fit takes it: with the branch of each point, and the deviations of its readings.

use crate::model::{AbscissaError, Assignment, ContactOf, Predicted};
use crate::statistics::median;
use crate::{Branch, Direction, Error, Experiment, Parameter, Point};

/// An experiment with the branches of its points.
#[derive(Clone, Debug)]
pub(crate) struct Assigned {
    /// The experiment with the present values of the parameters.
    pub experiment: Experiment,
    /// The branch of each point.
    pub branches: Vec<Branch>,
    /// The points by descending imposed value: from the largest contact to none.
    pub order: Vec<usize>,
    /// The noise that differences of neighbouring ordinates show; `None` for too few points.
    pub local_noise: Option<f64>,
    /// The standard deviation of an ordinate, known or estimated so far.
    pub noise: f64,
    /// What the errors of the abscissae do; empty where they are exact.
    pub abscissa_errors: Vec<AbscissaError>,
    /// The factors of the deviations of ordinates that also tell the contact depth; empty are 1.
    pub factors: Vec<f64>,
}

impl Assigned {
    /// Takes an experiment with the branches of its points, as a fit begins.
    pub fn new(experiment: Experiment, (branches, order, local_noise): Assignment) -> Self {
        let least = || {
            local_noise
                .unwrap_or(0.0)
                .max(1e-6 * experiment.compared_range())
        };
        Self {
            noise: experiment.usual_noise().unwrap_or_else(least),
            experiment,
            branches,
            order,
            local_noise,
            abscissa_errors: Vec::new(),
            factors: Vec::new(),
        }
    }

    /// Returns the branches, and of ways without adhesion the flat end as baseline. There the model holds on
    /// both sides, but a start needs the points in contact.
    pub fn branches_without_flat_ends(&self, level_is_free: bool) -> Vec<Branch> {
        let mut branches = self.branches.clone();
        let (experiment, noise) = (&self.experiment, self.noise);
        let kind = experiment.measurement.kind;
        let works = Branch::CONTACTS.map(|branch| experiment.work_of(branch));
        if kind.at_positions() && works == [0.0; 2] {
            experiment.take_flat_ends(&mut branches, noise, level_is_free);
        }
        branches
    }

    /// Takes the errors of the abscissae and the factors of the deviations by the slopes of the model.
    pub fn weigh(&mut self, contact_of: &ContactOf<'_>) -> Result<(), Error> {
        let (of, branches) = (&self.experiment, &self.branches);
        let noise = |i| self.own_deviation(i);
        let errors = of.abscissa_errors(contact_of, branches, &self.order, noise)?;
        let factors = of.noise_factors(contact_of, branches)?;
        (self.abscissa_errors, self.factors) = (errors, factors);
        Ok(())
    }

    /// Predicts the points of the experiment with other values, with derivatives with respect to `parameters`. Radii and
    /// speeds of the contact line with errors are predicted where they most likely lie, and from there along the tangent to
    /// where they were read: at the radius read, slopes and derivatives would go with its error.
    pub fn predict(
        &self,
        experiment: &Experiment,
        contact_of: &ContactOf<'_>,
        parameters: &[Parameter],
    ) -> Result<Predicted, Error> {
        let (errors, branches) = (&self.abscissa_errors, &self.branches);
        if errors.is_empty() || !experiment.measurement.kind.at_radii() {
            return experiment.predict_with(contact_of, branches, &self.order, parameters);
        }
        let mut moved = experiment.clone();
        for (point, error) in moved.measurement.points.iter_mut().zip(errors) {
            point.abscissa += error.shift;
        }
        for (line, error) in moved.line_speeds.iter_mut().zip(errors) {
            line.speed += error.speed_shift;
        }
        let mut predicted = moved.predict_with(contact_of, branches, &self.order, parameters)?;
        for (value, error) in predicted.values.iter_mut().zip(errors) {
            *value -= error.slope * error.shift + error.speed_slope * error.speed_shift;
        }
        Ok(predicted)
    }

    /// Returns the standard deviation of the ordinate of a point.
    pub fn own_deviation(&self, i: usize) -> f64 {
        let own = self.experiment.own_deviation(i).unwrap_or(self.noise);
        own * self.factors.get(i).copied().unwrap_or(1.0)
    }

    /// Returns the standard deviation of the residual of a point, with what the error of the abscissa adds.
    pub fn deviation(&self, i: usize) -> f64 {
        let own = self.own_deviation(i);
        match self.abscissa_errors.get(i) {
            Some(error) => own.hypot(error.part),
            None => own,
        }
    }

    /// Returns the standard deviation of the residual of a point alone: smaller than [`Self::deviation`] where errors of
    /// neighbours are alike.
    pub fn deviation_alone(&self, i: usize) -> f64 {
        let error = self.abscissa_errors.get(i);
        let error = error.map_or(0.0, |error| error.alone);
        self.own_deviation(i).hypot(error)
    }

    /// Returns the noise of an ordinate that is known, or that neighbours show; 0 if neither is.
    pub fn seen_noise(&self) -> f64 {
        let known = self.experiment.usual_noise();
        known.or(self.local_noise).unwrap_or(0.0)
    }

    /// Returns whether each point was measured on retract: where not all have a direction, after that of the largest
    /// imposed value.
    pub fn unloading(&self) -> Vec<bool> {
        let points = &self.experiment.measurement.points;
        let turn = self.order.first().copied().unwrap_or(0);
        let has_directions = points.iter().all(|point| point.direction.is_some());
        let unloads = |(i, point): (usize, &Point)| match has_directions {
            true => point.direction == Some(Direction::Retract),
            false => i > turn,
        };
        points.iter().enumerate().map(unloads).collect()
    }

    /// Returns the levels of the points off contact on approach and on retract above the baseline, N, if they differ by more
    /// than the noise: drag or drift.
    pub fn baselines_apart(&self) -> Option<[f64; 2]> {
        /// The distance over the noise of a reading from which on they differ, and the fewest points of each.
        const APART: f64 = 2.0;
        const FEWEST: usize = 5;
        let unloading = self.unloading();
        // Without adhesion points off contact are on the branch of the contact.
        let is_off = |i: usize, point: &Point| match self.branches[i] {
            Branch::Baseline => true,
            branch => {
                let is_contact = branch.is_contact() && self.experiment.work_of(branch) == 0.0;
                is_contact && self.experiment.imposed(point.abscissa) < 0.0
            }
        };
        let level = |way: bool| {
            let points = self.experiment.measurement.points.iter().enumerate();
            let of_way = points.filter(|&(i, point)| unloading[i] == way && is_off(i, point));
            let readings = of_way
                .map(|(_, point)| point.ordinate - self.experiment.baseline_at(point.abscissa));
            let readings: Vec<f64> = readings.collect();
            (readings.len() >= FEWEST).then(|| median(readings))
        };
        let levels = [level(false)?, level(true)?];
        let apart = (levels[0] - levels[1]).abs();
        (apart > APART * self.seen_noise()).then_some(levels)
    }

    /// Makes the error of experiments that have too few points for this number of `parameters`.
    pub fn too_few(all: &[Self], parameters: usize) -> Error {
        let points = all.iter().map(Self::counting).sum();
        let is_unknown = |own: &Self, i: usize| {
            own.branches[i] == Branch::LeftOut && own.experiment.is_speed_unknown(i)
        };
        let unknown = |own: &Self| {
            (0..own.branches.len())
                .filter(|&i| is_unknown(own, i))
                .count()
        };
        Error::too_few_points(points, parameters, all.iter().map(unknown).sum())
    }

    /// Returns the number of points that count.
    pub fn counting(&self) -> usize {
        self.counting_points().count()
    }

    pub fn counting_points(&self) -> impl Iterator<Item = usize> {
        let counts = |i: &usize| self.branches[*i] != Branch::LeftOut;
        (0..self.branches.len()).filter(counts)
    }
}
