//! The simple methods, which have no error estimate.

use super::tableau::tableau;

tableau! {
    /// The table of [`Euler`](crate::Euler).
    Euler1, Euler1Stages: order 1;
    stages {
        k1 at 0;
    }
    sum [k1: 1.0];
    last k2;
    dense [];
}

tableau! {
    /// The table of [`Heun`](crate::Heun).
    Heun2, Heun2Stages: order 2;
    stages {
        k1 at 0;
        k2 at 1.0 => [k1: 1.0];
    }
    sum scaled by 0.5; [k1: 1.0, k2: 1.0];
    last k3;
    dense [];
}

tableau! {
    /// The table of [`Ralston`](crate::Ralston).
    Ralston3, Ralston3Stages: order 3;
    stages {
        k1 at 0;
        k2 at 0.5 => [k1: 0.5];
        k3 at 0.75 => [k2: 0.75];
    }
    sum scaled by 1.0 / 9.0; [k1: 2.0, k2: 3.0, k3: 4.0];
    last k4;
    dense [];
}

tableau! {
    /// The table of [`Rk4`](crate::Rk4).
    Kutta4, Kutta4Stages: order 4;
    stages {
        k1 at 0;
        k2 at 0.5 => [k1: 0.5];
        k3 at 0.5 => [k2: 0.5];
        k4 at 1.0 => [k3: 1.0];
    }
    sum scaled by 1.0 / 3.0; [k2: 1.0, k3: 1.0, k1: 0.5, k4: 0.5];
    last k5;
    dense [];
}
