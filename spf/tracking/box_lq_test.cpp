#include "spf/tracking/box_lq.hpp"

#include <gtest/gtest.h>

#include <type_traits>

#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

template <class Size>
class BoxLq : public ::testing::Test {
 public:
  static constexpr int kInputs = Size::value;
  using Input = Eigen::Matrix<double, kInputs, 1>;

  /// A random problem with bounds that differ by component and side.
  static BoxLqProblem<kInputs> random_problem(std::uint64_t seed, int steps, bool rate) {
    RandomStream random{seed};
    BoxLqProblem<kInputs> problem;
    problem.steps = steps;
    problem.initial = draw<3>(random, 0.5);
    problem.previous_input = draw<kInputs>(random, 0.5);
    problem.state_weight = {10.0, 10.0, 2.0};
    problem.effort_weight = 0.05;
    problem.rate_weight = rate ? 0.1 : 0.0;
    problem.slack_weight = 0.0;
    for (int i = 0; i < kInputs; ++i) {
      problem.input_upper[i] = random.uniform(0.4, 1.2);
      problem.input_lower[i] = random.uniform(-1.2, -0.4);
    }
    problem.lower.setConstant(-1e30);
    problem.upper.setConstant(1e30);
    for (int k = 0; k < steps; ++k) {
      BoxLqStage<kInputs>& stage = problem.stages[static_cast<std::size_t>(k)];
      stage.x_by_heading = 0.1 * random.normal();
      stage.y_by_heading = 0.1 * random.normal();
      for (int i = 0; i < kInputs; ++i) stage.input_matrix.col(i) = draw<3>(random, 0.1);
      stage.input_matrix.diagonal().array() += 0.1;
      stage.offset = draw<3>(random, 0.02);
      stage.reference = draw<3>(random, 0.5);
      stage.input_reference = draw<kInputs>(random, 0.5);
    }
    return problem;
  }

 private:
  template <int Size_>
  static Eigen::Matrix<double, Size_, 1> draw(RandomStream& random, double size) {
    Eigen::Matrix<double, Size_, 1> drawn;
    for (int i = 0; i < Size_; ++i) drawn[i] = size * random.normal();
    return drawn;
  }
};

using Sizes = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>,
                               std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(BoxLq, Sizes);

// Two algorithms with nothing in common but the Riccati sweep.
TYPED_TEST(BoxLq, DualActiveSetAgreesWithProjectedNewton) {
  constexpr int kSize = TypeParam::value;
  BoxLqSolver<kSize> dual;
  BoxLqSolver<kSize> primal;
  int at_bound = 0;
  for (std::uint64_t n = 0; n < 1000; ++n) {
    SCOPED_TRACE(n);
    const int steps = 1 + static_cast<int>(n % 12);
    const BoxLqProblem<kSize> problem = TestFixture::random_problem(mix(50, n), steps, n % 2 == 0);
    InputSequence<kSize> by_dual;
    by_dual.fill(TestFixture::Input::Zero());
    InputSequence<kSize> by_primal = by_dual;
    const BoxLqOutcome outcome = dual.solve(problem, by_dual, 200);
    EXPECT_TRUE(outcome.solved);
    // The dual method keeps 40 active bounds at most.
    EXPECT_TRUE(!outcome.fell_back || steps * kSize > 40);
    EXPECT_TRUE(primal.refine(problem, by_primal, 200));
    for (std::size_t k = 0; k < static_cast<std::size_t>(steps); ++k) {
      EXPECT_LT((by_dual[k] - by_primal[k]).norm(), 1e-8);
      EXPECT_TRUE((by_dual[k].array() <= problem.input_upper.array()).all());
      EXPECT_TRUE((by_dual[k].array() >= problem.input_lower.array()).all());
      at_bound += static_cast<int>((by_dual[k].array() == problem.input_lower.array()).count());
    }
  }
  EXPECT_GT(at_bound, 500);
}

}  // namespace
}  // namespace spf
