//! Functions of vectors and matrices, by names that mean them directly before `(` only.

use nonholonomic_core::algebra::Rational;

use super::array::{Array, Shape};
use super::calls::Called;
use super::reports::{Outcome, Reported};
use super::resolver::Resolver;
use super::tensors::{Tensor, usage};
use crate::report::{Diagnostic, listed};
use crate::syntax::ast::{Expr, Name};

/// Whether a function of the language has this name.
pub(super) fn is_built_in(name: &str) -> bool {
    Called::named(name).is_some() || Tensor::named(name).is_some() || name == "sum" || name == "der"
}

impl Resolver {
    /// Whether a function of vectors has as many arguments as it takes.
    pub(super) fn count_of_tensor(
        &mut self,
        tensor: Tensor,
        expr: &Expr,
        name: &Name,
        given: usize,
    ) -> Outcome<()> {
        let (least, most) = tensor.arity();
        if given < least || given > most || (tensor == Tensor::Kinetic && given == 3) {
            let usage = usage(&name.text).unwrap_or_default();
            let wanted = match tensor {
                Tensor::Kinetic => "2 or 4 arguments".to_owned(),
                _ if least == 1 => "1 argument".to_owned(),
                _ => format!("{least} arguments"),
            };
            let what = format!("`{}` takes {wanted}, and {given} are given", name.text);
            let error = Diagnostic::new(expr.extent, what).way_out(format!("write `{usage}`"));
            return Err(self.report(expr, error));
        }
        Ok(())
    }

    /// A call of such a function.
    pub(super) fn tensor(
        &mut self,
        expr: &Expr,
        name: &Name,
        tensor: Tensor,
        arguments: &[Expr],
    ) -> Outcome<Array> {
        self.count_of_tensor(tensor, expr, name, arguments.len())?;
        match (tensor, arguments) {
            (Tensor::Diff, [of, by]) => return self.partial(expr, of, by),
            (Tensor::Identity, [size]) => return self.identity_matrix(size),
            _ => {}
        }
        let values: Vec<_> = arguments.iter().map(|argument| self.value(argument)).collect();
        let values = values.into_iter().collect::<Outcome<Vec<_>>>()?;
        match (tensor, values.as_slice()) {
            (Tensor::Transpose, [a]) => self.transpose(expr, a),
            (Tensor::Hat, [v]) => self.hat(expr, v),
            (Tensor::Vee, [a]) => self.vee(expr, a),
            (Tensor::Norm, [v]) => self.norm(expr, v),
            (Tensor::Diag, values) => self.diag(expr, arguments, values),
            (Tensor::About(axis), [angle]) => {
                let angle = self.as_number(&arguments[0], angle)?;
                self.about(expr, axis, angle)
            }
            (Tensor::Rot, [axis, angle]) => {
                let angle = self.as_number(&arguments[1], angle)?;
                self.about_axis(expr, &arguments[0], axis, angle)
            }
            (Tensor::BodyRate, [r]) => self.body_rate(expr, r),
            (Tensor::SpaceRate, [r]) => self.space_rate(expr, r),
            (Tensor::VelocityAt, [p, r, c]) => self.velocity_at(expr, p, r, c),
            (Tensor::Kinetic, [m, p]) => self.kinetic_of_point(expr, (&arguments[0], m), p),
            (Tensor::Kinetic, [m, i, p, r]) => self.kinetic_of_body(expr, (&arguments[0], m), i, p, r),
            _ => Err(Reported),
        }
    }

    /// Arguments of these shapes have no place in a function.
    pub(super) fn wrong_shapes(&mut self, expr: &Expr, takes: &str, values: &[&Array]) -> Reported {
        let shapes: Vec<String> = values.iter().map(|value| value.shape.to_string()).collect();
        let these = match shapes.as_slice() {
            [one] => format!("this is {one}"),
            several => format!("these are {}", listed(several)),
        };
        self.report(expr, Diagnostic::new(expr.extent, takes).evidence(these))
    }

    /// A value in a shape, where the number 0 is the zero of any shape.
    pub(super) fn in_shape(&self, value: &Array, shape: Shape) -> Option<Array> {
        if value.shape == shape {
            return Some(value.clone());
        }
        let zero = value.as_number().filter(|number| self.graph.is_literal_zero(*number))?;
        Some(Array { shape, entries: vec![zero; shape.len()] })
    }

    pub(super) fn transposed(&mut self, a: &Array) -> Option<Array> {
        let Shape::Matrix(rows, columns) = a.shape else { return None };
        let entries = (0..columns).flat_map(|j| a.column(j)).collect();
        let transposed = Array { shape: Shape::Matrix(columns, rows), entries };
        self.rotations.transposed(&mut self.graph, a, &transposed);
        Some(transposed)
    }

    fn transpose(&mut self, expr: &Expr, a: &Array) -> Outcome<Array> {
        match self.transposed(a) {
            Some(transposed) => Ok(transposed),
            None => Err(self.wrong_shapes(expr, "`transpose` takes a matrix", &[a])),
        }
    }

    /// The matrix of `cross(v, …)`.
    pub(super) fn hat(&mut self, expr: &Expr, v: &Array) -> Outcome<Array> {
        let (Shape::Vector(3), [x, y, z]) = (v.shape, v.entries.as_slice()) else {
            return Err(self.wrong_shapes(expr, "`hat` takes a vector of 3 entries", &[v]));
        };
        let zero = self.graph.zero();
        let [minus_x, minus_y, minus_z] = [*x, *y, *z].map(|entry| self.graph.formula(-entry));
        let entries = vec![zero, minus_z, *y, *z, zero, minus_x, minus_y, *x, zero];
        Ok(Array { shape: Shape::Matrix(3, 3), entries })
    }

    /// The vector of the skew part of a matrix.
    pub(super) fn vee(&mut self, expr: &Expr, a: &Array) -> Outcome<Array> {
        if a.shape != Shape::Matrix(3, 3) {
            return Err(self.wrong_shapes(expr, "`vee` takes a matrix of 3 × 3 entries", &[a]));
        }
        let half = Rational::new(1, 2);
        let mut entries = Vec::with_capacity(3);
        for (plus, minus) in [(7, 5), (2, 6), (3, 1)] {
            let terms = vec![(half.clone(), a.entries[plus]), (-half.clone(), a.entries[minus])];
            entries.push(self.sum_of(expr, terms)?);
        }
        Ok(Array::vector(entries))
    }

    fn norm(&mut self, expr: &Expr, v: &Array) -> Outcome<Array> {
        let Shape::Vector(_) = v.shape else {
            return Err(self.wrong_shapes(expr, "`norm` takes a vector", &[v]));
        };
        let square = self.inner_product(expr, &v.entries, &v.entries)?;
        Ok(Array::number(self.product_of(expr, &[(square, Rational::new(1, 2))])?))
    }

    /// `diag(a, b, c)`, or of a vector.
    fn diag(&mut self, expr: &Expr, arguments: &[Expr], values: &[Array]) -> Outcome<Array> {
        let entries = match values {
            [Array { shape: Shape::Vector(_), entries }] => entries.clone(),
            values => {
                let numbers = arguments.iter().zip(values);
                let numbers: Vec<_> = numbers.map(|(at, value)| self.as_number(at, value)).collect();
                numbers.into_iter().collect::<Outcome<Vec<_>>>()?
            }
        };
        let n = entries.len();
        self.reports.spend(expr.extent, n * n)?;
        let zero = self.graph.zero();
        let mut matrix = Array { shape: Shape::Matrix(n, n), entries: vec![zero; n * n] };
        for (k, entry) in entries.into_iter().enumerate() {
            matrix.entries[k * (n + 1)] = entry;
        }
        Ok(matrix)
    }

    fn identity_matrix(&mut self, size: &Expr) -> Outcome<Array> {
        const LARGEST: i64 = 64;
        let n = self.index(size)?;
        let Some(n) = usize::try_from(n).ok().filter(|_| (1..=LARGEST).contains(&n)) else {
            let what = format!("an identity matrix of {n} rows");
            let error =
                Diagnostic::new(size.extent, what).way_out(format!("it has from 1 to {LARGEST} rows"));
            return Err(self.report(size, error));
        };
        self.reports.spend(size.extent, n * n)?;
        let (zero, one) = (self.graph.zero(), self.graph.one());
        let mut matrix = Array { shape: Shape::Matrix(n, n), entries: vec![zero; n * n] };
        (0..n).for_each(|k| matrix.entries[k * (n + 1)] = one);
        Ok(matrix)
    }
}
