// The minimal model: γ against the slip parameter s, for three sizes of the ball.
#include "swirl/files/table.hpp"
#include "swirl/paper/figures.hpp"
#include "swirl/physics/rolling_ball.hpp"

namespace swirl {

FigurePlan plan_figure_ball(const PaperSettings&) {
    FigurePlan plan;
    plan.script = "figure_ball.py";
    plan.finish = [](const std::vector<nlohmann::ordered_json>&, const std::filesystem::path& out) {
        Table table({"ball_radius", "container_radius", "slip", "gamma", "varpi", "varpi_m"});
        for (const double share : {0.5, 0.75, 0.9})
            for (int k = 0; k <= 20; ++k) {
                RollingBall ball;
                ball.ball_radius = share * ball.container_radius;
                ball.slip = k / 20.0;
                table.add({ball.ball_radius, ball.container_radius, ball.slip, ball.gamma(),
                           ball.rotation(), ball.rotation_in_m_frame()});
            }
        FigureOutcome outcome;
        outcome.findings.push_back(
            "γ = s R_container/R_ball: a ball counterrotates where s is above R_ball/R_container, "
            "so always if it rolls (s = 1) and never if it slips freely (s = 0).");
        outcome.files.push_back(out / "figure_ball.csv");
        table.write(outcome.files.back());
        return outcome;
    };
    return plan;
}

}  // namespace swirl
