#include "motion/time_step.hpp"
#include "base/failure.hpp"
#include <cvode/cvode.h>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <utility>

namespace capsule {
namespace {

Eigen::Map<Vector> view(N_Vector v) {
  return {N_VGetArrayPointer(v), N_VGetLength(v)};
}

void check(int flag, const char *what) {
  if (flag < 0)
    throw NumericsFailure(failure_kind::step,
                          fmt::format("the time integrator failed in {} (CVODE code {})", what, flag),
                          "try a larger time.tolerance or a finer mesh.membrane");
}

// Error that Newton's iteration may leave, as a share of the step's tolerance. It lies in the shortest waves, where the
// load is stiffest: with CVODE's default of 0.1 it makes the steps short and starts buckles.
constexpr double newton_share = 0.01;

using Factors = Eigen::PartialPivLU<Matrix>;

// A linear system that is factored when it is first solved.
struct LinearSystem {
  decltype(Equations::correction) correction;
  Factors factors = {};
  bool factored = false;
};

// CVODE's linear systems by Eigen's factors, which go to OpenBLAS: SUNDIALS' own dense solver is many times
// slower on some hundred unknowns. The system belongs to the caller.
SUNLinearSolver linear_solver(LinearSystem &system, SUNContext context) {
  SUNLinearSolver solver = SUNLinSolNewEmpty(context);
  solver->content = &system;
  solver->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  solver->ops->setup = [](SUNLinearSolver self, SUNMatrix /*matrix*/) {
    static_cast<LinearSystem *>(self->content)->factored = false;
    return 0;
  };
  solver->ops->solve = [](SUNLinearSolver self, SUNMatrix matrix, N_Vector x, N_Vector b,
                          realtype /*tolerance*/) {
    LinearSystem &mine = *static_cast<LinearSystem *>(self->content);
    view(x) = mine.correction([&]() -> Vector {
      if (!mine.factored)
        mine.factors.compute(
            Eigen::Map<const Matrix>(SM_DATA_D(matrix), SM_ROWS_D(matrix), SM_COLUMNS_D(matrix)));
      mine.factored = true;
      return mine.factors.solve(view(b));
    });
    return 0;
  };
  solver->ops->free = [](SUNLinearSolver self) {
    self->content = nullptr;
    SUNLinSolFreeEmpty(self);
    return 0;
  };
  return solver;
}

} // namespace

struct BdfIntegrator::Memory {
  explicit Memory(Equations given) : equations(std::move(given)), system{equations.correction} {}

  Equations equations;
  SUNContext context = nullptr;
  N_Vector state = nullptr;
  SUNMatrix matrix = nullptr;
  LinearSystem system;
  SUNLinearSolver solver = nullptr;
  void *cvode = nullptr;
  double time = 0;

  static int rate(realtype /*t*/, N_Vector y, N_Vector rate, void *data) {
    Vector result;
    if (!static_cast<Memory *>(data)->equations.rate(view(y), result))
      return 1;
    view(rate) = result;
    return 0;
  }

  static int jacobian(realtype /*t*/, N_Vector y, N_Vector /*fy*/, SUNMatrix out, void *data,
                      N_Vector /*tmp1*/, N_Vector /*tmp2*/, N_Vector /*tmp3*/) {
    Matrix result;
    if (!static_cast<Memory *>(data)->equations.jacobian(view(y), result))
      return 1;
    Eigen::Map<Matrix>(SM_DATA_D(out), result.rows(), result.cols()) = result;
    return 0;
  }
};

BdfIntegrator::BdfIntegrator(Equations equations, double time, const Vector &state, double tolerance)
    : memory_(std::make_unique<Memory>(std::move(equations))) {
  Memory &m = *memory_;
  m.time = time;
  check(SUNContext_Create(nullptr, &m.context), "SUNContext_Create");
  m.state = N_VNew_Serial(state.size(), m.context);
  view(m.state) = state;
  m.cvode = CVodeCreate(CV_BDF, m.context);
  check(CVodeInit(m.cvode, &Memory::rate, time, m.state), "CVodeInit");
  check(CVodeSetErrFile(m.cvode, nullptr), "CVodeSetErrFile");
  check(CVodeSStolerances(m.cvode, 0, tolerance), "CVodeSStolerances");
  check(CVodeSetUserData(m.cvode, &m), "CVodeSetUserData");
  m.matrix = SUNDenseMatrix(state.size(), state.size(), m.context);
  m.solver = linear_solver(m.system, m.context);
  check(CVodeSetLinearSolver(m.cvode, m.solver, m.matrix), "CVodeSetLinearSolver");
  check(CVodeSetJacFn(m.cvode, &Memory::jacobian), "CVodeSetJacFn");
  check(CVodeSetNonlinConvCoef(m.cvode, newton_share), "CVodeSetNonlinConvCoef");
}

BdfIntegrator::~BdfIntegrator() {
  Memory &m = *memory_;
  CVodeFree(&m.cvode);
  SUNLinSolFree(m.solver);
  SUNMatDestroy(m.matrix);
  N_VDestroy(m.state);
  SUNContext_Free(&m.context);
}

void BdfIntegrator::step() {
  // The end of the interval only tells CVODE the scale for its first step.
  const double ahead = memory_->time + 1;
  check(CVode(memory_->cvode, ahead, memory_->state, &memory_->time, CV_ONE_STEP), "CVode");
}

double BdfIntegrator::time() const {
  return memory_->time;
}

double BdfIntegrator::previous_time() const {
  double last = 0;
  CVodeGetLastStep(memory_->cvode, &last);
  return memory_->time - last;
}

Vector BdfIntegrator::state_at(double time) const {
  Vector state(N_VGetLength(memory_->state));
  const N_Vector target = N_VMake_Serial(state.size(), state.data(), memory_->context);
  const int flag = CVodeGetDky(memory_->cvode, time, 0, target);
  N_VDestroy(target);
  check(flag, "CVodeGetDky");
  return state;
}

ExplicitIntegrator::ExplicitIntegrator(Scheme scheme, Rate rate, double time, const Vector &state,
                                       double step)
    : scheme_(scheme), rate_(std::move(rate)), time_(time), previous_(time), step_(step), state_(state),
      before_(state) {
  if (scheme_ == Scheme::rk4)
    rate_at_state_ = rate_(state_);
}

void ExplicitIntegrator::step() {
  before_ = state_;
  previous_ = time_;
  if (scheme_ == Scheme::euler) {
    state_ += step_ * rate_(state_);
  } else {
    const double h = step_;
    rate_before_ = rate_at_state_;
    const Vector &k1 = rate_before_;
    const Vector k2 = rate_(before_ + h / 2 * k1);
    const Vector k3 = rate_(before_ + h / 2 * k2);
    const Vector k4 = rate_(before_ + h * k3);
    state_ += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    rate_at_state_ = rate_(state_); // k1 of the next step
  }
  time_ += step_;
}

Vector ExplicitIntegrator::state_at(double time) const {
  const double s = (time - previous_) / step_;
  if (scheme_ == Scheme::euler)
    return before_ + s * (state_ - before_);
  const Vector change = state_ - before_;
  return before_ +
         s * (step_ * rate_before_ + s * (3 * change - step_ * (2 * rate_before_ + rate_at_state_) +
                                          s * (step_ * (rate_before_ + rate_at_state_) - 2 * change)));
}

double stability_limit(Scheme scheme) {
  // Runge and Kutta's: the real root of 1 - z/2 + z^2/6 - z^3/24, where |R(-z)| reaches 1 again.
  return scheme == Scheme::euler ? 2 : 2.7852935634052816;
}

} // namespace capsule
