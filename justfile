# The recipes that people and CI run. `just` alone lists them.

# where recorded and reference voyages lie
voyages_dir := env("INSD_VOYAGES", "voyages")

_default:
    @just --list --unsorted

# a ship sails in this terminal; options go through: just demo --speed 20 --scenario 5
demo *options:
    cargo run --release -- demo {{options}}

# all tests of all crates
test *options:
    cargo test --workspace {{options}}

# tests that need a kernel of their own, see tests/vm/README.md
vm *options:
    tests/vm/prepare
    cargo build -p insd
    CARGO_TARGET_X86_64_UNKNOWN_LINUX_GNU_RUNNER="{{justfile_directory()}}/tests/vm/runner" VM_TIMEOUT=400 \
        cargo test --workspace --test vm_pps --test vm_can --test vm_bus -- --ignored {{options}}

# what CI refuses: unformatted code and any warning
lint:
    cargo fmt --all --check
    cargo clippy --workspace --all-targets -- -D warnings

# formats everything
fmt:
    cargo fmt --all

# many seeds of one scenario: errors, NEES and coverage with confidence intervals
campaign scenario="02" seeds="1..41" *options:
    cargo run --release -- campaign {{scenario}} --seeds {{seeds}} {{options}}

# replays and scores every voyage of a directory; solutions go to target/voyages
voyages dir=voyages_dir:
    #!/usr/bin/env bash
    set -euo pipefail
    cargo build --release
    mkdir -p target/voyages
    for voyage in {{dir}}/*/; do
        [ -e "$voyage/voyage.toml" ] || continue
        name=$(basename "$voyage")
        echo "== $name"
        target/release/insd replay "$voyage" --out "target/voyages/$name.csv"
        for truth in "$voyage"/truth.csv "$voyage"/truth.csv.zst; do
            if [ -e "$truth" ]; then
                target/release/insd evaluate "target/voyages/$name.csv" "$truth"
            fi
        done
    done

# the mechanisation alone, without sensor errors, for two hours in a rough sea
noise-free:
    cargo run --release -p insd-tests --example noise_free

# instruction counts; needs valgrind and `cargo install gungraun-runner --version 0.20.0`
bench *options:
    cargo bench --workspace {{options}}

# what an NMEA 2000 bus costs the daemon, and what its node puts on the bus
can-cost seconds="60" background="400":
    cargo build --release
    cargo run --release -p insd-tests --example can_cost -- --seconds {{seconds}} --background {{background}}

# a fuzz target for a while; needs nightly and `cargo install cargo-fuzz --version 0.13.2`
fuzz target="nmea" seconds="60":
    cargo +nightly fuzz run --sanitizer none {{target}} -- -max_total_time={{seconds}} -max_len=2048 -timeout=20

# all fuzz targets in turn, each for so many seconds; ends at the first finding
fuzz-all seconds="60":
    #!/usr/bin/env bash
    set -euo pipefail
    for target in $(cargo +nightly fuzz list); do
        echo "== $target"
        just fuzz "$target" {{seconds}}
    done

# the README's picture of the demo, the same bytes every time
picture:
    cargo run --release -p insd --example demo_picture -- docs/demo.svg

# the pictures and tables of docs/alignment.md, the same bytes every time
alignment-page:
    cargo run --release -p insd-tests --example alignment_page -- docs

# all that CI does
ci:
    .ci/run
