//! What a wrong parameter on one side leads to.
