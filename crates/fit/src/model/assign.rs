//! The branches of measured points, read from the data.
//!
//! A model that jumps off within the residual has wrong optima, because the sum of squares then
//! jumps where a point changes its branch. So each point has its branch before the fit.

use super::split::{FEWEST, KnownBaseline, tail};
use super::{Branch, Direction, Experiment, Kind, Parameter, Point};
use crate::Error;
use crate::statistics::{differences_of, noise_over, robust_deviation};

/// The radii of a retract that are within this part of the largest radius of the approach, or within this number of
/// standard deviations of a radius, may belong to a line that does not move.
const PINNED: f64 = 0.02;
const PINNED_ERRORS: f64 = 3.0;
/// The noise over which a pull of the contact below the baseline is clear.
const CLEAR: f64 = 10.0;
/// The noise of the readings without a contact, over that which neighbours show, from which on neighbours are alike.
const ALIKE: f64 = 3.0;
/// The part of the steps of a way that go in its direction, if its points come in order.
const IN_ORDER: f64 = 0.6;

/// The branch of each point; the points by descending imposed value, from the largest contact to none; and the noise that
/// differences of neighbouring ordinates show, `None` for too few points.
pub(crate) type Assignment = (Vec<Branch>, Vec<usize>, Option<f64>);

impl Experiment {
    /// Accepts the points and reads their branches for a fit, of which `is_free` tells what it may change.
    ///
    /// At contact radii all points are in contact, except those with a radius of 0. Of a retract
    /// with a work of adhesion of its own, the points within 2 % of the largest radius, or 3 standard deviations, are left
    /// out, because their line may not have moved yet.
    ///
    /// Against penetrations or heights each segment is read from its largest contact on. If it has
    /// a jump from below the baseline to it, larger than 6 times the noise, the points before the
    /// jump are in contact and those after it are on the baseline; a spike is no jump. The baseline
    /// is flat to 6 times the noise, and at the level that is known unless this level is free. A slope that is free is
    /// read from the ends of the segments before.
    /// Without such a jump a flat end of the segment is the baseline. Points between contact and
    /// baseline are left out.
    pub(crate) fn assign(&self, is_free: impl Fn(Parameter) -> bool) -> Result<Assignment, Error> {
        let points = &self.measurement.points;
        self.accept_points()?;
        self.accept_stiffness()?;
        let order = self.order();
        let noise_in = |numbers: &[usize]| {
            let compared: Vec<f64> = numbers.iter().map(|&i| self.compared(i)).collect();
            noise_of(&compared)
        };
        if self.relaxing.is_some() {
            let local_noise = noise_in(&(0..points.len()).collect::<Vec<_>>());
            return Ok((self.branches_in_time(), order, local_noise));
        }
        let mut branches: Vec<Branch> = points.iter().map(Point::branch).collect();
        let mut local_noise = noise_in(&order);
        match self.measurement.kind {
            Kind::LoadRadius | Kind::PenetrationRadius => {
                let receding = Parameter::WorkOfAdhesionReceding;
                let hysteretic = is_free(receding) || self.get(receding).is_some();
                self.assign_radii(hysteretic, &mut branches);
                self.leave_out_unknown_speeds(&mut branches);
            }
            Kind::StiffnessRadius | Kind::StiffnessLoad | Kind::StiffnessDepth => {
                branches.fill(Branch::Advancing);
            }
            Kind::LoadPenetration | Kind::ForceHeight => {
                let segments = self.segments();
                let noises: Vec<f64> = segments.iter().filter_map(|one| noise_in(one)).collect();
                let mean = noises.iter().sum::<f64>() / noises.len() as f64;
                local_noise = (!noises.is_empty()).then_some(mean);
                let filtered = self.filtered_noise(&segments);
                let is_more =
                    |filtered: &f64| local_noise.is_some_and(|near| *filtered > ALIKE * near);
                local_noise = filtered.filter(is_more).or(local_noise);
                let noise = self.usual_noise().or(local_noise).unwrap_or(0.0);
                let adheres = |work| is_free(work) || self.get(work).is_some_and(|w| w > 0.0);
                if Parameter::WORKS.into_iter().any(adheres) {
                    let level = Parameter::LEVELS.into_iter().any(&is_free);
                    let slope = is_free(Parameter::BaselineSlope);
                    let baseline = KnownBaseline {
                        slope_is_free: slope,
                        ..self.known_baseline(noise, level || slope)
                    };
                    let slope = if slope {
                        self.tilt(&segments, baseline)
                    } else {
                        self.baseline_slope
                    };
                    let split = |readings: &[f64]| baseline.split(readings);
                    self.split(&mut branches, &segments, slope, split);
                }
            }
        }
        Ok((branches, order, local_noise))
    }

    /// Returns the points by descending imposed value: from the largest contact to none.
    pub(super) fn order(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.measurement.points.len()).collect();
        self.sort(&mut order);
        order
    }

    /// Sorts points by descending imposed value.
    fn sort(&self, numbers: &mut [usize]) {
        let imposed = |i: &usize| self.sense() * self.measurement.points[*i].abscissa;
        numbers.sort_by(|i, j| imposed(j).total_cmp(&imposed(i)));
    }

    /// Accepts points whose abscissae are finite.
    pub(crate) fn accept_abscissae(&self) -> Result<(), Error> {
        let [abscissa, _] = self.measurement.kind.names();
        let mut points = self.measurement.points.iter();
        points.try_for_each(|point| self.accept_number(point.line, abscissa, point.abscissa))
    }

    /// Accepts a number of a point.
    fn accept_number(&self, line: u64, name: &'static str, value: f64) -> Result<(), Error> {
        if !value.is_finite() {
            return Err(self.refused(line, name, value, "finite"));
        }
        if value.abs() > 1e100 {
            let allowed = "below 1e100: check the unit";
            return Err(self.refused(line, name, value, allowed));
        }
        Ok(())
    }

    /// The error of a number of a point.
    pub(super) fn refused(
        &self,
        line: u64,
        name: &'static str,
        value: f64,
        allowed: &'static str,
    ) -> Error {
        Error::Point {
            measurement: self.measurement.name.clone(),
            numbering: self.measurement.numbering,
            line,
            name,
            value,
            allowed,
        }
    }

    fn accept_points(&self) -> Result<(), Error> {
        let measurement = &self.measurement;
        let points = &measurement.points;
        let at_radii = measurement.kind.at_radii();
        let [abscissa, ordinate] = measurement.kind.names();
        let end_of_exact_sphere = self.bodies.end_of_exact_sphere();
        self.accept_abscissae()?;
        for point in points {
            self.accept_number(point.line, ordinate, point.ordinate)?;
            let radius = point.abscissa;
            let allowed = if radius < 0.0 {
                "0 (no contact) or positive"
            } else if radius >= self.bodies.largest_radius() {
                "below the radius of the sphere: check the units of both"
            } else if end_of_exact_sphere.is_some_and(|end| radius >= end) {
                "below 0.55 R, up to which the exact sphere is solved on a film: leave out the points of wider contacts"
            } else {
                continue;
            };
            if at_radii {
                return Err(self.refused(point.line, abscissa, radius, allowed));
            }
        }
        let values: [fn(&Point) -> f64; 2] = [|point| point.abscissa, |point| point.ordinate];
        for (name, value) in [abscissa, ordinate].into_iter().zip(values) {
            let mut all = points.iter().map(value);
            if let Some(value) = all.next()
                && all.all(|other| other == value)
            {
                return Err(Error::Constant {
                    measurement: measurement.name.clone(),
                    name,
                    value,
                });
            }
        }
        Ok(())
    }

    /// Assigns points at measured contact radii.
    fn assign_radii(&self, hysteretic: bool, branches: &mut [Branch]) {
        let points = &self.measurement.points;
        let without_contact = if self.measurement.kind == Kind::LoadRadius {
            Branch::Baseline
        } else {
            Branch::LeftOut
        };
        let advancing = points.iter().zip(&*branches);
        let advancing = advancing.filter(|(_, branch)| **branch == Branch::Advancing);
        let largest = advancing
            .map(|(point, _)| point.abscissa)
            .fold(0.0, f64::max);
        let near = (PINNED * largest).max(PINNED_ERRORS * self.usual_abscissa_noise());
        for (point, branch) in points.iter().zip(branches) {
            let may_be_pinned = hysteretic
                && *branch == Branch::Receding
                && largest > 0.0
                && point.abscissa > largest - near;
            if point.abscissa == 0.0 {
                *branch = without_contact;
            } else if may_be_pinned {
                *branch = Branch::LeftOut;
            }
        }
    }

    /// Returns the segments of a measurement, each by descending imposed value.
    ///
    /// Points without a direction are two segments if they come in the order of a loading and an
    /// unloading.
    fn segments(&self) -> Vec<Vec<usize>> {
        let points = &self.measurement.points;
        let sense = self.sense();
        let key = |i: usize| sense * points[i].abscissa;
        let mut segments = Vec::new();
        for direction in [Some(Direction::Approach), Some(Direction::Retract), None] {
            let all: Vec<usize> = (0..points.len())
                .filter(|&i| points[i].direction == direction)
                .collect();
            let turn = (0..all.len()).max_by(|&i, &j| key(all[i]).total_cmp(&key(all[j])));
            let ways = match turn {
                Some(turn) if direction.is_none() => {
                    let (loading, unloading) = all.split_at(turn + 1);
                    let goes = |way: &[usize], up: bool| {
                        let right = way.windows(2);
                        let right = right.filter(|pair| (key(pair[1]) > key(pair[0])) == up);
                        way.len() >= FEWEST
                            && right.count() as f64 >= IN_ORDER * (way.len() - 1) as f64
                    };
                    if goes(loading, true) && goes(unloading, false) {
                        vec![loading.to_vec(), unloading.to_vec()]
                    } else {
                        vec![all]
                    }
                }
                _ => vec![all],
            };
            for mut way in ways {
                self.sort(&mut way);
                if !way.is_empty() {
                    segments.push(way);
                }
            }
        }
        segments
    }

    /// Returns the points of loading and those of unloading, each by descending imposed value;
    /// `None` where the data do not have both. Points without a direction have them if they come in
    /// the order of a loading and an unloading.
    pub(crate) fn ways(&self) -> Option<[Vec<usize>; 2]> {
        if self.measurement.kind.is_stiffness() {
            return None;
        }
        let points = &self.measurement.points;
        let segments: [Vec<usize>; 2] = self.segments().try_into().ok()?;
        let directions = [0, 1].map(|way| points[segments[way][0]].direction);
        let are_ways = directions == Direction::ALL.map(Some) || directions == [None; 2];
        let are_long = segments.iter().all(|way| way.len() >= FEWEST);
        (are_ways && are_long).then_some(segments)
    }

    /// Tells the points in contact from those on the baseline, in ways between the largest contact and none.
    fn split(
        &self,
        branches: &mut [Branch],
        segments: &[Vec<usize>],
        slope: f64,
        split: impl Fn(&[f64]) -> [usize; 2],
    ) {
        for way in segments.iter().filter(|way| way.len() >= FEWEST) {
            let [contact_ends, baseline_begins] = split(&self.readings(way, slope));
            for &i in &way[contact_ends..baseline_begins] {
                branches[i] = Branch::LeftOut;
            }
            for &i in &way[baseline_begins..] {
                branches[i] = Branch::Baseline;
            }
        }
    }

    /// Returns by how much the force falls below the baseline where a contact ends with a jump, N; `None` where none
    /// does, or not by clearly more than the `noise`.
    pub(crate) fn pull(&self, noise: f64) -> Option<f64> {
        let baseline = self.known_baseline(noise, true);
        let of_way = |way: &Vec<usize>| {
            (way.len() >= FEWEST)
                .then(|| baseline.pull(&self.readings(way, self.baseline_slope)))
                .flatten()
        };
        let segments = self.segments();
        let pulls = segments.iter().filter_map(of_way);
        let most = pulls.fold(0.0, f64::max);
        (most > CLEAR * noise).then_some(most)
    }

    /// Returns the largest noise of the readings at the ends of the segments.
    fn filtered_noise(&self, segments: &[Vec<usize>]) -> Option<f64> {
        let ways = segments.iter().filter(|way| way.len() >= FEWEST);
        let noises = ways.map(|way| noise_of_end(&self.readings(way, 0.0)));
        noises.reduce(f64::max)
    }

    /// Returns the ordinates of points without the `slope` of the baseline.
    pub(super) fn readings(&self, numbers: &[usize], slope: f64) -> Vec<f64> {
        let points = numbers.iter().map(|&i| &self.measurement.points[i]);
        points
            .map(|point| point.ordinate - slope * (point.abscissa - self.contact_point))
            .collect()
    }

    /// Returns what is known of the baseline, with the noise of a reading.
    fn known_baseline(&self, noise: f64, level_is_free: bool) -> KnownBaseline {
        KnownBaseline {
            level: self.load_offset + self.baseline,
            level_is_free,
            noise,
            slope_is_free: false,
        }
    }

    /// Takes the flat ends of the ways from the contact. Without adhesion the model describes them, too, but where the
    /// contact begins they tell where a fit starts.
    pub(crate) fn take_flat_ends(&self, branches: &mut [Branch], noise: f64, level_is_free: bool) {
        let baseline = self.known_baseline(noise, level_is_free);
        let split = |readings: &[f64]| baseline.flat_end(readings);
        self.split(branches, &self.segments(), self.baseline_slope, split);
    }
}

/// Returns the noise that fourth differences of the last readings of a way show over growing distances: over short ones a
/// filter has made them alike. A curve, a bend or a jump among them shows little.
fn noise_of_end(readings: &[f64]) -> f64 {
    /// The part of the readings over which a difference extends at most.
    const PART: usize = 3;
    let last = &readings[readings.len() - tail(readings.len())..];
    let distances = std::iter::successors(Some(1), |distance| Some(2 * distance));
    let distances = distances.take_while(|distance| 4 * distance * PART <= last.len());
    distances
        .map(|distance| noise_over(distance, last))
        .fold(0.0, f64::max)
}

/// Estimates the standard deviation of independent noise from differences of readings in order: the second
/// ones, or higher ones where these are much smaller, because few points of a curve bend more than noise
/// does.
pub(crate) fn noise_of(readings: &[f64]) -> Option<f64> {
    /// The part of the estimate from lower differences below which that from higher ones counts.
    const MUCH_SMALLER: f64 = 0.5;
    /// The variances of the differences of orders 2, 3 and 4 of numbers with the variance 1.
    const VARIANCES: [f64; 3] = [6.0, 20.0, 70.0];
    let mut found: Option<f64> = None;
    let mut differences = differences_of(readings);
    for variance in VARIANCES {
        differences = differences_of(&differences);
        if differences.len() < FEWEST {
            break;
        }
        let noise = robust_deviation(differences.iter().copied()) / variance.sqrt();
        if found.is_none_or(|before| noise < MUCH_SMALLER * before) {
            found = Some(noise);
        }
    }
    found
}
