# Many devices through the pipe, and a table of what came out, by Snakemake:
#
#   snakemake -s ../examples/flows/sweep.smk --cores all --config bin=../target/release/
#
# With --keep-going a device that fails leaves the others alone; why it failed is in its log. Other
# devices, as names and arguments of the generator (also from a file, with --configfile):
#
#   ... --config bin=../target/release/ devices='{"gear-9": "gear --order 9 --height 0.3"}'
#
# On a cluster the same, with the plugin snakemake-executor-plugin-slurm; a device is a job, so that its
# stages run on one node:
#
#   snakemake -s ../examples/flows/sweep.smk --executor slurm --jobs 100 --config bin=/path/to/bin/ \
#       --default-resources slurm_account=ACCOUNT slurm_partition=PARTITION

import csv
import json

BIN = config.get("bin", "")
BODY = config.get("body", BIN + "body")
DEVICES = config.get("devices") or {
    **{f"gear-{n}": f"gear --order {n} --height 0.3" for n in (8, 12, 24, 30)},
    **{f"tsv-{n}": f"tsv --order {n} --thickness 5e-3" for n in (8, 16, 32)},
    **{f"impeller-{n}": f"impeller --order {n} --bore 0.15" for n in (5, 7)},
}
# Size of the elements, for all stages that want to know it, and what else the mesher is told.
SIZE = config.get("size", "--max-volume 1e-3")
TETWEDGE = config.get("tetwedge", "")
# Smallest dihedral angle, degrees, that the last column of the table holds the elements against.
ANGLE = float(config.get("angle", 10))


wildcard_constraints:
    device="[^/.]+",


localrules:
    all,
    table,


rule all:
    input:
        "sweep.csv",
        expand("{device}.vtk", device=DEVICES),


rule body:
    output:
        "{device}.stl",
    params:
        arguments=lambda wildcards: DEVICES[wildcards.device],
    group:
        "device"
    shell:
        "{BODY} {params.arguments} -o {output}"


rule symdetect:
    input:
        "{device}.stl",
    output:
        "{device}.sym.tmesh",
    log:
        "{device}.sym.log",
    group:
        "device"
    shell:
        "{BIN}symdetect {input} -o {output} 2> {log}"


rule wedgecut:
    input:
        "{device}.sym.tmesh",
    output:
        "{device}.wedge.tmesh",
    log:
        "{device}.wedge.log",
    group:
        "device"
    shell:
        "{BIN}wedgecut -v {SIZE} {input} -o {output} 2> {log}"


rule periodic_surf:
    input:
        "{device}.wedge.tmesh",
    output:
        "{device}.surf.tmesh",
    log:
        "{device}.surf.log",
    group:
        "device"
    shell:
        "{BIN}periodic-surf -v {SIZE} {input} -o {output} 2> {log}"


rule tetwedge:
    input:
        "{device}.surf.tmesh",
    output:
        "{device}.tet.tmesh",
    log:
        "{device}.tet.log",
    group:
        "device"
    resources:
        mem_mb=2000,
        runtime=30,
    shell:
        "{BIN}tetwedge -v {SIZE} --min-dihedral {ANGLE} {TETWEDGE} {input} -o {output} 2> {log}"


rule rotassemble:
    input:
        "{device}.tet.tmesh",
    output:
        "{device}.vtk",
    group:
        "device"
    shell:
        "{BIN}rotassemble {input} -o {output}"


rule meshqual:
    input:
        "{device}.tet.tmesh",
    output:
        "{device}.json",
    group:
        "device"
    shell:
        "{BIN}meshqual --check --json {output} {input} > /dev/null"


rule table:
    input:
        expand("{device}.json", device=DEVICES),
    output:
        "sweep.csv",
    run:
        with open(output[0], "w", newline="") as file:
            table = csv.writer(file, lineterminator="\n")
            head = ["device", "order", "tetrahedra", "volume", "min_dihedral_deg", "p01", "met", "passed"]
            table.writerow(head)
            for device, path in zip(DEVICES, input):
                with open(path) as report_file:
                    report = json.load(report_file)
                order = report["symmetry"].get("outside", report["symmetry"])["order"]
                angle = report["metrics"]["min_dihedral_deg"]
                figures = [report["volume"], angle["min"], angle["p01"]]
                table.writerow(
                    [device, order, report["tetrahedra"]]
                    + [f"{x:.6g}" for x in figures]
                    + [angle["min"] >= ANGLE, report["checks"]["passed"]]
                )
