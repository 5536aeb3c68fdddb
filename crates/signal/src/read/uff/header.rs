//! The eleven lines before the values of a function.

use crate::error::ReadError;

/// Lines between the type of a dataset and its values.
pub(super) const HEADER_LINES: usize = 11;

/// Layout of binary values, given after `58b`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct BinaryLayout {
    pub big_endian: bool,
    /// Number of bytes the file declares; programs count them differently.
    pub declared: usize,
}

impl BinaryLayout {
    /// From the line with the type; `None` if the values are text.
    pub(super) fn of(kind: &str, number: usize) -> Result<Option<Self>, ReadError> {
        let Some(rest) = kind.trim_start().strip_prefix("58").and_then(|rest| rest.strip_prefix(['b', 'B']))
        else {
            return Ok(None);
        };
        let fields: Vec<usize> = rest.split_whitespace().map_while(|field| field.parse().ok()).collect();
        let &[order, float, lines, declared, ..] = &fields[..] else {
            return Err(ReadError::Malformed {
                what: format!("function {number} is binary but does not say how"),
            });
        };
        if float != 2 {
            return Err(ReadError::Unsupported {
                what: format!("floating-point format {float} of function {number}"),
                instead: "write it with IEEE 754 numbers (format 2)",
            });
        }
        if lines != HEADER_LINES {
            return Err(ReadError::Malformed {
                what: format!("function {number} has {lines} header lines, not 11"),
            });
        }
        Ok(Some(Self { big_endian: order == 2, declared }))
    }
}

/// The header of a function.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FunctionHeader {
    pub name: String,
    pub number: usize,
    function_type: i64,
    pub complex: bool,
    pub double: bool,
    pub points: usize,
    pub even: bool,
    pub start: f64,
    pub step: f64,
    abscissa: i64,
    pub abscissa_unit: Option<String>,
    ordinate: i64,
    ordinate_unit: Option<String>,
}

impl FunctionHeader {
    pub(super) fn of(lines: &[String], number: usize) -> Result<Self, ReadError> {
        let function = &lines[5];
        let whole = |field: &str, what: &str| {
            field.trim().parse::<i64>().map_err(|_| ReadError::Malformed {
                what: format!("{what} of function {number} is \"{}\"", field.trim()),
            })
        };
        let form = &lines[6];
        let kind = whole(columns(form, 0, 10), "the type of the ordinate")?;
        let points = whole(columns(form, 10, 10), "the number of points")?;
        let even = whole(columns(form, 20, 10), "the spacing of the abscissa")? == 1;
        if !matches!(kind, 2 | 4 | 5 | 6) || points < 0 {
            return Err(ReadError::Malformed {
                what: format!("function {number} has ordinates of type {kind} and {points} points"),
            });
        }
        let real =
            |start: usize| columns(form, start, 13).trim().replace(['D', 'd'], "e").parse().unwrap_or(0.0);
        Ok(Self {
            name: name(&lines[0], function, number),
            number,
            function_type: whole(columns(function, 0, 5), "the type")?,
            complex: matches!(kind, 5 | 6),
            double: matches!(kind, 4 | 6),
            points: points as usize,
            even,
            start: real(30),
            step: real(43),
            abscissa: columns(&lines[7], 0, 10).trim().parse().unwrap_or(0),
            abscissa_unit: unit_label(&lines[7]),
            ordinate: columns(&lines[8], 0, 10).trim().parse().unwrap_or(0),
            ordinate_unit: unit_label(&lines[8]),
        })
    }

    /// Whether it is a function of time: by its abscissa, or by its type if the abscissa is unspecified.
    pub(super) const fn is_over_time(&self) -> bool {
        self.abscissa == 17 || (self.abscissa == 0 && matches!(self.function_type, 0 | 1))
    }

    pub(super) const fn abscissa_name(&self) -> &'static str {
        match self.abscissa {
            18 => "frequency",
            17 => "time",
            19 => "revolutions per minute",
            20 => "the order",
            _ => "no time",
        }
    }

    /// Unit of the ordinate; if the file names only the quantity, its SI unit, as the format specifies.
    ///
    /// # Returns
    /// The unit, and whether it is assumed.
    pub(super) fn unit(&self) -> (Option<String>, bool) {
        if self.ordinate_unit.is_some() {
            return (self.ordinate_unit.clone(), false);
        }
        let unit = match self.ordinate {
            8 => "m",
            11 => "m/s",
            12 => "m/s^2",
            9 | 13 => "N",
            _ => return (None, false),
        };
        (Some(unit.to_owned()), true)
    }

    /// Values per point: the abscissa if it is uneven, and one or two for the ordinate.
    pub(super) const fn values_per_point(&self) -> usize {
        (if self.complex { 2 } else { 1 }) + (if self.even { 0 } else { 1 })
    }

    const fn size(&self) -> usize {
        if self.double { 8 } else { 4 }
    }

    /// Bytes of an abscissa in the binary form.
    pub(super) const fn abscissa_size(&self, binary: &BinaryLayout) -> usize {
        let short = self.points * (4 + (self.values_per_point() - 1) * self.size());
        if !self.even && binary.declared == short { 4 } else { self.size() }
    }

    /// Bytes of all values in the binary form.
    pub(super) const fn bytes(&self, binary: &BinaryLayout) -> usize {
        let ordinates = if self.complex { 2 } else { 1 } * self.size();
        let abscissa = if self.even { 0 } else { self.abscissa_size(binary) };
        self.points * (ordinates + abscissa)
    }
}

/// Part of a line by its columns, as far as the line goes.
fn columns(line: &str, start: usize, length: usize) -> &str {
    let end = (start + length).min(line.len());
    line.get(start.min(end)..end).unwrap_or_default()
}

fn label(text: &str) -> Option<&str> {
    Some(text.trim()).filter(|text| !text.is_empty() && !text.eq_ignore_ascii_case("none"))
}

/// The second of the two texts of 20 characters, after four numbers of 10, 5, 5 and 5.
fn unit_label(line: &str) -> Option<String> {
    label(columns(line, 47, 20)).map(str::to_owned)
}

/// The first identification line, or else the point and the direction of the response.
fn name(identification: &str, function: &str, number: usize) -> String {
    if let Some(text) = label(identification) {
        return text.to_owned();
    }
    let (entity, node) = (label(columns(function, 31, 10)), columns(function, 41, 10).trim());
    let direction = match columns(function, 51, 4).trim() {
        "1" => "+X",
        "-1" => "-X",
        "2" => "+Y",
        "-2" => "-Y",
        "3" => "+Z",
        "-3" => "-Z",
        _ => "",
    };
    match (entity, node) {
        (_, "" | "0") => format!("function {number}"),
        (Some(entity), node) => format!("{entity}:{node}{direction}"),
        (None, node) => format!("{node}{direction}"),
    }
}
