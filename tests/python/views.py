"""Arrays that outlive their owners, copies and exceptions. The slow suite runs this under valgrind,
which checks every memory access."""

import gc
import pickle

import numpy as np

import swirl


def views():
    sim = swirl.Simulation(discs=12)
    s = sim.snapshot()
    m = s.m_frame()
    f = sim.sample(0.2, 50)
    t = f.m_frame()
    stored = [
        s.position,
        m.velocity,
        f.position,
        f[3].spin,
        t.angle,
        f.whole_periods,
        s.container_centre,
    ]
    rows = sim.step(500)
    other = pickle.loads(pickle.dumps(sim))
    del sim, s, m, f, t
    gc.collect()
    other.advance(periods=0.2)
    return stored, rows, other.snapshot().position


stored, rows, p = views()
gc.collect()
print(sum(float(k.sum()) for k in stored) + float(rows["time"].sum()) + float(p.sum()))


class Mean:
    def block(self, frames):
        return frames.position.mean()


r = swirl.run(discs=5, events=1500, warmup=0, measure=["density", Mean])
t = r.measured["density"]["by_time"]
del r
gc.collect()
print(float(np.nansum(t)))
for bad in (dict(mu=-1), dict(x=1)):
    try:
        swirl.run(**bad)
    except (ValueError, TypeError):
        pass
