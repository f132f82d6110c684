# A sweep as a Snakemake workflow: each part is a job of its own, then the table is collected.
#
#     snakemake --snakefile examples/sweep.smk --cores 4 --config discs=5:48 replicates=8
#
# The entries of --config are options of `swirl sweep`, and also `swirl`, the program, and `parts`.
PLAN = {name: value for name, value in config.items() if name not in ("swirl", "parts")} or {"discs": "20:2:40"}
PROGRAM = config.get("swirl", "swirl")
PARTS = int(config.get("parts", 4))
OPTIONS = " ".join(f"--{name.replace('_', '-')} {value}" for name, value in PLAN.items())


rule table:
    input:
        expand("parts/{k}.done", k=range(1, PARTS + 1))
    output:
        "table.csv"
    shell:
        "{PROGRAM} collect study --csv {output}"


# Without --finish-others a part is complete only when its own runs are. Results that exist are not computed again.
rule part:
    output:
        touch("parts/{k}.done")
    threads: 1
    shell:
        "{PROGRAM} sweep {OPTIONS} --out study --part {wildcards.k}/{PARTS} --threads {threads} --quiet"
