//! The name of what determines the last digits of a solve, besides its arguments.

/// Returns the name of this build and of the features of this processor that change rounding.
///
/// Numbers of two programs belong into one table only if these names are equal. The build is named
/// by a hash over all sources of `tabulate` and `interp`, the versions of the dependencies, the
/// compiler and its settings (`build.rs` of this crate). Libraries for linear algebra choose their
/// instructions by the features of the processor when they run.
pub fn name() -> String {
    format!(
        "{} on {}{}",
        env!("BUILD_HASH"),
        std::env::consts::ARCH,
        features()
    )
}

#[cfg(target_arch = "x86_64")]
fn features() -> String {
    let found = [
        ("avx2", is_x86_feature_detected!("avx2")),
        ("fma", is_x86_feature_detected!("fma")),
        ("avx512f", is_x86_feature_detected!("avx512f")),
    ];
    let found = found.iter().filter(|(_, found)| *found);
    found.map(|(name, _)| format!(" {name}")).collect()
}

#[cfg(not(target_arch = "x86_64"))]
fn features() -> String {
    String::new()
}
