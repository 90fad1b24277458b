//! Measured points, read from CSV.

use std::fmt;

/// The quantity that was measured with the load.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Against {
    /// The contact radius, m.
    ContactRadius,
    /// The penetration, m.
    Penetration,
}

impl Against {
    const ALL: [Self; 2] = [Self::ContactRadius, Self::Penetration];

    /// Returns the name of its column.
    const fn name(self) -> &'static str {
        match self {
            Self::ContactRadius => "contact_radius",
            Self::Penetration => "penetration",
        }
    }
}

impl fmt::Display for Against {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Measured points: loads (N) against contact radii or penetrations (m).
#[derive(Clone, Debug, PartialEq)]
pub struct Data {
    /// The quantity that the loads were measured against.
    pub against: Against,
    /// Pairs of contact radius or penetration, and load.
    pub points: Vec<(f64, f64)>,
}

impl Data {
    /// Reads points from CSV.
    ///
    /// A header names two columns, `load` and one of `contact_radius` and `penetration`. Each line
    /// below it is a point in SI units. Lines that begin with `#` are comments.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut lines = text
            .lines()
            .enumerate()
            .map(|(i, line)| (i + 1, line.trim()));
        let mut lines = lines
            .by_ref()
            .filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
        let fields = |line: &str| {
            line.split(',')
                .map(|field| field.trim().to_owned())
                .collect::<Vec<_>>()
        };
        let (_, header) = lines
            .next()
            .ok_or("no header: contact_radius,load or load,penetration")?;
        let columns = fields(header);
        let column = |name: &str| columns.iter().position(|column| column == name);
        let against = Against::ALL
            .into_iter()
            .find_map(|against| Some((against, column(against.name())?)));
        let (Some((against, abscissa)), Some(load), 2) = (against, column("load"), columns.len())
        else {
            return Err(format!(
                "the header is {header:?}, not contact_radius,load or load,penetration"
            ));
        };
        let point = |(number, line): (usize, &str)| {
            let fields = fields(line);
            if fields.len() != 2 {
                return Err(format!("line {number}: {} fields, not 2", fields.len()));
            }
            let value = |index: usize| match fields[index].parse::<f64>() {
                Ok(value) if value.is_finite() => Ok(value),
                _ => Err(format!(
                    "line {number}: {} is {:?}, not a finite number",
                    columns[index], fields[index]
                )),
            };
            let (abscissa, load) = (value(abscissa)?, value(load)?);
            if against == Against::ContactRadius && abscissa <= 0.0 {
                return Err(format!(
                    "line {number}: contact_radius is {abscissa:?}, not above 0"
                ));
            }
            Ok((abscissa, load))
        };
        Ok(Self {
            against,
            points: lines.map(point).collect::<Result<_, _>>()?,
        })
    }

    /// Returns the difference of the largest and the smallest contact radius or penetration, and
    /// that of the loads.
    pub fn ranges(&self) -> [f64; 2] {
        let range = |values: &mut dyn Iterator<Item = f64>| {
            let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| {
                [low.min(v), high.max(v)]
            });
            high - low
        };
        [
            range(&mut self.points.iter().map(|point| point.0)),
            range(&mut self.points.iter().map(|point| point.1)),
        ]
    }
}
