//! What is logged: a level, or directives as `RUST_LOG` has them.

use insd_web::SECURITY;
use tracing_subscriber::EnvFilter;

/// A filter of a level or of directives as `RUST_LOG` has them. What is about security passes it whatever
/// they say.
///
/// # Errors
/// They are not understood, or are about security.
pub fn filter(directives: &str) -> Result<EnvFilter, String> {
    if directives.to_ascii_lowercase().contains(SECURITY) {
        return Err(format!("`{SECURITY}` cannot be filtered: those lines are always written"));
    }
    // the longest target counts, so that no directive without it or for fields alone comes before this
    EnvFilter::try_new(directives).map(always_told).map_err(|fault| fault.to_string())
}

fn always_told(filter: EnvFilter) -> EnvFilter {
    match format!("{SECURITY}=info").parse() {
        Ok(directive) => filter.add_directive(directive),
        Err(_) => filter,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_directive_about_security_is_refused() {
        for text in ["security=off", "info,SECURITY=error", "security[{host}]=off", "info,security"]
        {
            assert!(filter(text).unwrap_err().contains("always written"), "{text}");
        }
    }
}
