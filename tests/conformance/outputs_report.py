"""The report of outputs.py: tables in Markdown."""

import collections

UNITS = {
    "lat": "m", "lon": "m", "height": "m", "heading": "°", "heading_m": "°", "course": "°",
    "course_m": "°",
    "roll": "°", "heel": "°", "pitch": "°", "heave": "m", "sog": "m/s", "ahead": "m/s", "starboard": "m/s",
    "heave_rate": "m/s", "vn": "m/s", "ve": "m/s", "vd": "m/s", "rot": "°/min", "clock": "s", "day": "d",
}
SIGNED = ("roll", "heel", "pitch", "heave", "heave_rate", "rot", "starboard", "vd", "lat", "lon")


def port(name, epochs, rest):
    """One line on what a port has sent, and how its sentences found their epochs."""
    sentences = epochs.sentences
    how = collections.Counter(sentence.how or "none" for sentence in sentences)
    print(f"{name}: {len(sentences)} sentences, {len(rest)} pieces of bytes in none, "
          f"{sum(not sentence.good for sentence in sentences)} with a wrong checksum, "
          f"{sum(len(sentence.text) > 80 for sentence in sentences)} longer than 82 bytes; epochs "
          + ", ".join(f"{count} by {word}" for word, count in how.items()))
    if epochs.notes:
        print("    " + "; ".join(epochs.notes))


def shown(quantity, value):
    name = {"heading_m": "heading magnetic", "course_m": "course magnetic", "clock": "time"}
    text = "0" if value < 2e-6 else f"{value:.2g}" if value < 1 else f"{value:.4g}"
    return f"{name.get(quantity, quantity)} {text} {UNITS[quantity]}"


def report(result, names, rest, marks, full):
    """All tables. `full`: a line for each reader of each sentence."""
    (long_table if full else short_table)(result, names)
    signs(result)
    print("\nMarks of quality: " + "; ".join(
        f"{kind} {mark} ×{count}" for (kind, mark), count in sorted(marks.items())))
    findings(result, rest)


def cell(line):
    """How many fields of a sentence a reader found, and how many of them are not what was meant."""
    if line is None or line.count["nothing"] == line.count["shown"]:
        return "–"
    if not line.count["fields"]:
        return "0"
    beyond = f" ({line.count['beyond']:,} differ)" if line.count["beyond"] else ""
    refused = f", {line.count['refused']:,} refused" if line.count["refused"] else ""
    return f"{line.count['fields']:,}{beyond}{refused}"


def short_table(result, names):
    print("\n| sentence | sent | " + " | ".join(names) + " | greatest difference without a reason |")
    print("|---|---:|" + "---:|" * len(names) + "---|")
    total = collections.Counter()
    for kind, sent in sorted(result.sent.items()):
        lines = [result.table.get((kind, name)) for name in names]
        worst = {}
        for name, line in zip(names, lines):
            for quantity, value in (line.worst if line else {}).items():
                worst[quantity] = max(value, worst.get(quantity, 0.0))
            total[name] += line.count["fields"] if line else 0
        text = ", ".join(shown(quantity, value) for quantity, value in worst.items())
        print(f"| {kind} | {sent:,} | " + " | ".join(map(cell, lines)) + f" | {text} |")
    totals = " | ".join(f"{total[name]:,}" for name in names)
    print(f"| all | {sum(result.sent.values()):,} | {totals} | |")


def long_table(result, _):
    print("\n| sentence | reader | shown | read | refused | fields | beyond | greatest difference |")
    print("|---|---|---:|---:|---:|---:|---:|---|")
    for (kind, reader), line in sorted(result.table.items()):
        names = ("shown", "read", "refused", "fields", "beyond")
        counts = " | ".join(str(line.count[name]) for name in names)
        worst = ", ".join(shown(quantity, value) for quantity, value in line.worst.items())
        print(f"| {kind} | {reader} | {counts} | {worst} |")


def signs(result):
    print("\n| quantity | sentence | positive in truth | same sign | negative in truth | same sign "
          "| readers |")
    print("|---|---|---:|---:|---:|---:|---|")
    rows = collections.defaultdict(list)
    for (kind, reader), line in sorted(result.table.items()):
        for place, quantity in enumerate(SIGNED):
            same, unlike = ([line.signs[quantity, side, like] for side in (True, False)]
                            for like in (True, False))
            if any(same + unlike):
                rows[place, kind, *same, *unlike].append(reader.split()[0])
    for (place, kind, above, below, *unlike), who in sorted(rows.items()):
        print(f"| {SIGNED[place]} | {kind} | {above + unlike[0]:,} | {above:,} | {below + unlike[1]:,} | "
              f"{below:,} | {', '.join(who)} |")


def findings(result, rest):
    print("\nRefusals, and differences beyond the limit:")
    for (reader, kind, quantity, reason), count in sorted(result.reasons.items(), key=str):
        print(f"  {count} {kind} {quantity} {reader}: {reason or 'UNEXPLAINED'}")
    seen = collections.Counter()
    for reader, sentence, quantity, value, true, limit in result.beyond:
        seen[reader, sentence.kind, quantity] += 1
        if seen[reader, sentence.kind, quantity] <= 1:
            print(f"    {reader}: {sentence.text}: {quantity} {value}, truth {true}, limit {limit:.3g}, "
                  f"epoch {sentence.row} by {sentence.how}")
    print(f"Refused without a known reason: {len(result.refused)}")
    for reader, sentence in result.refused[:20]:
        print(f"    {reader}: {sentence.text}")
    for text in rest[:20]:
        print(f"    in no sentence: {text!r}")
