"""`swirl paper`: makes figures. The program passes the call as JSON:

    /usr/bin/python3 paper '{"figures": ["5b"], "out": "out", "module": "build/release/python"}'

Prints {"figures": [{"name", "findings", "files", "problem"}], "runs": …} as JSON.
"""

import json
import os
import sys


def main():
    call = json.loads(sys.argv[1])
    if call.get("module"):
        sys.path.insert(0, call["module"])
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    import catalogue
    import study
    settings = study.Settings(**{name: call[name] for name in ("quick", "events", "out", "seed", "first_seeds", "threads",
                                                               "seeds_of_point") if name in call})
    figures = catalogue.named(call["figures"])
    plans = [figure.points(settings) for figure in figures]
    runs = study.make([point for plan in plans for point in plan], settings, part=tuple(call.get("part", (1, 1))))
    made = []
    for figure, plan in zip(figures, plans) if "part" not in call else ():
        findings, files = figure.write(plan, settings)
        problem = ""
        if figure.draw and call.get("draw", True):
            try:
                figure.draw(files[0])
                files += [files[0].removesuffix("csv") + kind for kind in ("png", "pdf")]
            except (Exception, SystemExit) as error:  # the other figures are made
                problem = str(error)
        made.append({"name": figure.name, "findings": findings + study.remarks(plan), "files": files,
                     "problem": problem})
    print(json.dumps({"figures": made, **runs}))


if __name__ == "__main__":
    main()
