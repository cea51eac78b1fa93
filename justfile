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

# the README's picture of the demo, the same bytes every time
picture:
    cargo run --release -p insd --example demo_picture -- docs/demo.svg

# the pictures and tables of docs/alignment.md, the same bytes every time
alignment-page:
    cargo run --release -p insd-tests --example alignment_page -- docs

# all that CI does
ci:
    .ci/run
