/** The page's Runs with a worker that has no thread: this engine evaluates runs that are finished.
 *  */
export const runsOf = (Runs, engine, perRate) =>
    new Runs(() => {
        const worker = {
            postMessage: ({runs}) =>
                say({kind: "crossing", crossings: perRate((rate) => engine.crossing(runs[rate]))}),
        };
        const say = (data) => queueMicrotask(() => worker.onmessage({data}));
        say({kind: "ready"});
        return worker;
    }, 1);
