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
    cargo test -p insd --features vision --test camera {{options}}

# tests that need a kernel of their own, see tests/vm/README.md
vm *options:
    tests/vm/prepare
    cargo build -p insd
    CARGO_TARGET_X86_64_UNKNOWN_LINUX_GNU_RUNNER="{{justfile_directory()}}/tests/vm/runner" VM_TIMEOUT=400 \
        cargo test --workspace --test vm_pps --test vm_can --test vm_bus -- --ignored {{options}}

# the Debian package; needs `cargo install cargo-deb@3.8.0 cargo-cyclonedx@0.5.9 --locked`
deb *options:
    systemd/package {{options}}

# insd in a container, made of its package; see docs/container.md
container *options:
    systemd/package
    podman build -f contrib/container/Containerfile -t insd {{options}} "${CARGO_TARGET_DIR:-target}/debian"

# the package for arm64, built soon, installed and started under emulation; see tests/arm64/README.md. Not in CI: it is one more build of everything
arm64:
    tests/arm64/prepare
    cargo build --release -p insd
    tests/arm64/run "$(INSD_ARCH=arm64 INSD_PROFILE=trial systemd/package)" "${CARGO_TARGET_DIR:-target}/release/insd"

# the package of this commit twice, in places that have nothing in common: are they the same bytes? Two release builds
reproducible arch="":
    contrib/release/reproducible {{arch}}

# all files of a release, signed; see docs/release.md
release key folder="target/release-files" *options:
    contrib/release/make {{options}} {{key}} {{folder}}

# the package installed, started, hurt, upgraded and purged in a small Debian, see tests/vm/README.md
vm-service:
    tests/vm/prepare service
    VM_TIMEOUT=400 tests/vm/service/run "$(systemd/package)"

# what CI refuses: unformatted code and any warning
lint:
    cargo fmt --all --check
    cargo clippy --workspace --all-targets -- -D warnings
    cargo clippy -p insd --features vision --all-targets -- -D warnings

# known weaknesses, licences and sources of all crates; needs `cargo install cargo-deny@0.20.2 --locked`
deny *checks:
    cargo deny check {{checks}}

# the crates for researchers, all in one go: `just publish --dry-run`
publish *options:
    cargo publish --locked -p insd-base -p insd-estimation -p insd-nav {{options}}

# the book of docs/, in target/book; needs `cargo install mdbook@0.5.4 --locked`
book *options:
    mdbook build docs {{options}}

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

# when outputs leave, beside so many busy threads: at the far end of a terminal, and as the daemon counts
timing seconds="60" busy="4":
    cargo build --release
    cargo run --release -p insd-tests --example timing -- target/release/insd {{seconds}} {{busy}}

# the heave filter alone in seas of 4 to 20 s with IMUs of three grades: errors over their bars, two minutes
heave-campaign:
    cargo test --release -p insd-nav --test heave -- --ignored --nocapture the_campaign

# heave as two ports send it, against the truth: sea states 3 to 6, periods 4 to 20 s; about three minutes
heave-chain grade="navigation":
    #!/usr/bin/env bash
    set -euo pipefail
    cargo build --release
    mkdir -p target/heave
    cd target/heave
    for sea in "0.88 7.5" "1.88 8.8" "3.25 9.7" "5.0 12.4" "0.9 4" "1.9 6" "3.2 15" "1.9 20" "5.0 20"; do
        set -- $sea
        ../release/insd simulate ../../tests/conformance/heave-scenario.toml --out sailed --set imu.grade={{grade}} \
            --set sea.significant_height_m=$1 --set sea.peak_period_s=$2 > /dev/null
        ../release/insd replay sailed --out nav.csv --config ../../tests/conformance/heave-ports.toml --sent sent 2> /dev/null
        echo "== $1 m, $2 s"
        python3 ../../tests/conformance/heave.py sailed sent/imu.sent 0 0 0 500
        python3 ../../tests/conformance/heave.py sailed sent/bow.sent 40 8 5 500
        rm -r sailed sent
    done

# simulated MEMS voyages with minutes without fixes, as known then and afterwards: errors, limits, NEES; a minute for each seed
smooth-campaign seeds="1..21":
    cargo build --release
    python3 contrib/smoothing/campaign.py --seeds {{seeds}}

# installations that are not as configured, through simulated voyages: errors, and whether they are told
installation seeds="20" *voyage:
    cargo run --release -p insd-engine --example installation -- {{seeds}} {{voyage}}

# voyages with a MEMS IMU whose biases follow its temperature beyond the data sheet: claims, refusals, what is found
temperature seeds="9":
    cargo run --release -p insd-engine --example temperature -- {{seeds}}

# voyages with a sensor that lies, all kinds, both grades, every suite of sensors: what it costs, who is told and named
faults draws="5" *options:
    cargo run --release -p insd-lab --example faults -- {{draws}} {{options}}

# antennas that are a compass, and docking aids, that lie: whether and how soon it is told, and what it costs
aid-faults seeds="10" *options:
    cargo run --release -p insd-lab --example aid_faults -- {{seeds}} {{options}}

# the recipes of docs/connect.md with gpsd, chrony and, where it is installed, Signal K
conformance-connect *options:
    cargo build --release -p insd
    tests/conformance/connect.py target/release/insd {{options}}

# a ship that reports ashore through a broker that goes away, kills and 2 kB/s, into PostgreSQL; needs Debian's mosquitto and postgresql, and root
conformance-fleet *options:
    cargo build --release -p insd
    tests/conformance/fleet.py target/release/insd {{options}}

# the same over TLS with certificates that are made for it
conformance-fleet-tls *options:
    cargo build --release -p insd --features tls
    tests/conformance/fleet.py target/release/insd --tls {{options}}

# the dashboard and the alert rules ashore, by a Prometheus that asks the page of a made-up ship; needs Debian's prometheus
conformance-dashboard:
    cargo build -p insd-web --example show
    tests/conformance/dashboard.py "${CARGO_TARGET_DIR:-target}/debug/examples/show"

# what the daemon costs at 200 samples a second with ten outputs, and how soon it speaks
footprint seconds="60":
    cargo build --release
    INSD_PROGRAM="${CARGO_TARGET_DIR:-target}/release/insd" \
        cargo run --release -p insd-tests --example footprint {{seconds}}

# days of a ship through the daemon's pipeline as fast as it goes: memory, counters, gaps
soak hours="72" imu_hz="50":
    cargo run --release -p insd-tests --example soak -- {{hours}} {{imu_hz}}

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
    cargo run --release -p insd-lab --example demo_picture -- docs/demo.svg

# the status page with a made-up ship: alignment, underway, fault
page scene="underway" address="127.0.0.1:8470":
    cargo run -p insd-web --example show -- {{scene}} {{address}}

# the status page in a browser; needs Debian's chromium and chromium-driver
browser *options:
    cargo test -p insd-web --test browser -- --ignored {{options}}

# the pictures of docs/page.md
page-pictures:
    INSD_PICTURES=docs/page cargo test -p insd-web --test browser -- --ignored pictures

# the pictures and tables of docs/alignment.md, the same bytes every time
alignment-page:
    cargo run --release -p insd-tests --example alignment_page -- docs

# single points and carrier differences of real receivers against where they were: the table of docs/satellites.md; INSD_RAW_GNSS: the sets that the page names
satellites:
    cargo run --release -p insd-tests --example satellites -- docs/satellites.md

# rovers against bases of real receivers, fixed and wrong: the table of docs/rtk.md; INSD_RAW_GNSS as above
rtk:
    cargo run --release -p insd-gnss --example rtk

# antennas against each other, real, made up and on a made-up berthing: the tables of docs/compass.md, a quarter of an hour; INSD_RAW_GNSS as above, INSD_VOYAGES: the folder of voyages
compass:
    cargo run --release -p insd-gnss --example compass -- docs/compass.md

# a walk with a MEMS IMU and a receiver, fixes against ranges, with all satellites and few: a table of docs/satellites.md; INSD_RAW_GNSS as above
walk:
    cargo build --release
    cargo run --release -p insd-tests --example walk -- "${CARGO_TARGET_DIR:-target}/release/insd" docs/satellites.md

# scenario 26 with many seeds, fixes against ranges: a table of docs/satellites.md; ten minutes for 20 seeds
satellites-campaign seeds="20":
    cargo build --release
    cargo run --release -p insd-tests --example satellites_campaign -- "${CARGO_TARGET_DIR:-target}/release/insd" {{seeds}} docs/satellites.md

# simulated ports in which something is wrong, spoofers and satellites and bases: do protection levels hold? A table of docs/protection.md; half an hour for 50 seeds
integrity-campaign seeds="50" *options:
    cargo build --release
    cargo run --release -p insd-tests --example integrity_campaign -- "${CARGO_TARGET_DIR:-target}/release/insd" {{seeds}} {{options}}

# ships at their berths in all seas, on all moorings, with all grades: the table of docs/figures.md; ten minutes for 24 seeds
berth-campaign seeds="24":
    cargo run --release -p insd-tests --example berth_campaign -- {{seeds}} docs/figures.md

# outages of ships whose errors repeat and of others, with what is learnt of their sensors and without: one table, ten minutes
learning-campaign ships="12" *page:
    cargo run --release -p insd-tests --example learning_campaign -- {{ships}} {{page}}

# independent readers on what the ports send in a simulated voyage; INSD_GPSDECODE: gpsd 3.27's decoder
conformance-outputs *options:
    #!/usr/bin/env bash
    set -euo pipefail
    peers=target/conformance
    mkdir -p "$peers"
    cargo build --release -p insd
    insd=${CARGO_TARGET_DIR:-target}/release/insd
    rm -rf "$peers/voyage" "$peers/sent"
    "$insd" simulate tests/conformance/outputs-voyage.toml --seed 1 --out "$peers/voyage"
    "$insd" replay "$peers/voyage" --out "$peers/nav.csv" --sent "$peers/sent" \
        --config tests/conformance/outputs.toml
    [ -x "$peers/venv/bin/pip" ] || python3 -m venv "$peers/venv"
    "$peers/venv/bin/pip" install --quiet pynmeagps==1.1.8 pynmea2==1.19.0
    npm install --silent --no-audit --no-fund --prefix "$peers" @signalk/nmea0183-signalk@3.20.1
    gpsdecode=${INSD_GPSDECODE:-$(command -v gpsdecode || true)}
    # --first: what leaves first at an epoch, before what has no time; --rot-damping: as the profiles have it
    NODE_PATH="$peers/node_modules" "$peers/venv/bin/python" tests/conformance/outputs.py \
        "$peers"/sent/epochs.csv "$peers"/sent/*.sent ${gpsdecode:+--gpsdecode "$gpsdecode"} \
        --first gpsd=ZDA --first ecdis=ZDA --first vdr=ZDA --first seapath=ZDA --first radar-arpa=ZDA \
        --first ais=GNS --first autopilot=RMC --first phins=HDT --first others=PRDID \
        --rot-damping ais=1 --rot-damping autopilot=0.5 {{options}}

# the Python package: wheel, tests, notebooks; needs python3 with venv, and PyPI
python:
    cargo build --release -p insd
    python/check "${CARGO_TARGET_DIR:-target}/release/insd"

# independent readers on what `insd convert --to` writes; needs PyPI
conformance-convert:
    #!/usr/bin/env bash
    set -euo pipefail
    cargo build --release -p insd
    venv=${CARGO_TARGET_DIR:-target}/conformance/convert
    [ -x "$venv/bin/pip" ] || python3 -m venv "$venv"
    "$venv/bin/pip" install --quiet mcap==1.6.0 gpxpy==1.6.2 geojson==3.3.0 fastkml==1.4.0 rosbags==0.11.9 \
        jsonschema==4.26.0 foxglove-sdk==0.30.3 protobuf
    "$venv/bin/python" tests/conformance/convert.py "${CARGO_TARGET_DIR:-target}/release/insd"

# all that CI does
ci:
    .ci/run
