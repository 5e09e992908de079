//! Binding to the system TetGen library.
