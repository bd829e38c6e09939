//! The method of Bogacki and Shampine of order 3.

use super::tableau::{embedded, tableau};

tableau! {
    /// The table of [`Bs23`](crate::Bs23).
    BogackiShampine3, BogackiShampine3Stages: order 3;
    stages {
        k1 at 0;
        k2 at 0.5 => [k1: 0.5];
        k3 at 0.75 => [k2: 0.75];
    }
    sum scaled by 1.0 / 9.0; [k1: 2.0, k2: 3.0, k3: 4.0];
    last k4;
    dense [];
}

embedded! {
    BogackiShampine3: error order 3, first same as last true, held at 2.25;
    error [k1: -5.0 / 72.0, k2: 1.0 / 12.0, k3: 1.0 / 9.0] last [-1.0 / 8.0];
}
