#!/usr/bin/env python3
"""Packages of ISO 19848 that a ship has sent, read by DNV's vista-sdk and held against its schema.

    mosquitto_sub ... -t 'insd/v1/#' -F '%p' | tests/conformance/iso19848.py [SCHEMA]

Needs vista-sdk 0.3.2 from PyPI, and jsonschema with SCHEMA, which is `schemas/json/TimeSeriesData.schema.json` of dnv-opensource/vista-sdk. Ends with 1
where a package is not as the schema says, a channel is none of the vessel information structure, or a table is not whole.
"""

import json
import sys

from vista_sdk.local_id import LocalId

OWN = "insd.alert."


def complaints(package):
    for series in package["Package"]["TimeSeriesData"]:
        for table in series.get("TabularData", []):
            channels, sets = table["DataChannelID"], table["DataSet"]
            for channel in channels:
                if str(LocalId.parse(channel)) != channel:
                    yield f"{channel} is read as {LocalId.parse(channel)}"
            if table["NumberOfDataSet"] != len(sets) or table["NumberOfDataChannel"] != len(channels):
                yield f"{table['NumberOfDataSet']} sets of {table['NumberOfDataChannel']} channels"
            yield from (f"{own['TimeStamp']}: {own['Value']}" for own in sets if len(own["Value"]) != len(channels))
        for own in series.get("EventData", {}).get("DataSet", []):
            if not own["DataChannelID"].startswith(OWN):
                yield f"an event of {own['DataChannelID']}"


def main():
    packages = [json.loads(line) for line in sys.stdin if line.strip()]
    found = [text for package in packages for text in complaints(package)]
    if len(sys.argv) > 1:
        import jsonschema

        schema = json.load(open(sys.argv[1]))
        validator = jsonschema.Draft202012Validator(schema, format_checker=jsonschema.FormatChecker())
        found += [fault.message for package in packages for fault in validator.iter_errors(package)]
    rows = sum(
        len(table["DataSet"])
        for package in packages
        for series in package["Package"]["TimeSeriesData"]
        for table in series.get("TabularData", [])
    )
    print(f"{len(packages)} packages, {rows} rows, {len(found)} complaints")
    for text in found[:20]:
        print(text, file=sys.stderr)
    sys.exit(1 if found or not rows else 0)


if __name__ == "__main__":
    main()
