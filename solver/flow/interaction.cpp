#include "flow/interaction.hpp"
#include <utility>

namespace capsule {

Interaction::Interaction(std::shared_ptr<const Wall> wall, const MembraneMesh &mesh, const Vector &position,
                         Layers layers, std::span<const Image> images, Drive drive)
    : wall_(std::move(wall)), mesh_(&mesh), images_(images.begin(), images.end()), drive_(drive),
      shape_(shape_at(mesh, position)), single_(ring_stokeslet, mesh, shape_, images_),
      base_velocity_(2 * mesh.nodes) {
  if (layers == Layers::both)
    double_ = MembraneLayer(ring_stresslet, mesh, shape_, images_);
  for (std::size_t k = 0; k < mesh.parts.size(); ++k) {
    couplings_.emplace_back(*wall_, mesh, shape_, k, layers, images_, drive_);
    base_velocity_(mesh.rows(k)) = couplings_[k].base_velocity();
  }
}

Vector Interaction::single_at_wall(const Vector &density) const {
  Vector sum = couplings_[0].single_at_wall(density(mesh_->rows(0)));
  for (std::size_t k = 1; k < couplings_.size(); ++k)
    sum += couplings_[k].single_at_wall(density(mesh_->rows(k)));
  return sum;
}

Vector Interaction::double_at_wall(const Vector &density) const {
  Vector sum = couplings_[0].double_at_wall(density(mesh_->rows(0)));
  for (std::size_t k = 1; k < couplings_.size(); ++k)
    sum += couplings_[k].double_at_wall(density(mesh_->rows(k)));
  return sum;
}

Matrix Interaction::single_at_wall() const {
  Matrix result(wall_->unknowns(), 2 * mesh_->nodes);
  for (std::size_t k = 0; k < couplings_.size(); ++k)
    result(Eigen::all, mesh_->rows(k)) = couplings_[k].single_at_wall();
  return result;
}

Matrix Interaction::double_at_wall() const {
  Matrix result(wall_->unknowns(), 2 * mesh_->nodes);
  for (std::size_t k = 0; k < couplings_.size(); ++k)
    result(Eigen::all, mesh_->rows(k)) = couplings_[k].double_at_wall();
  return result;
}

Vector Interaction::answer_of_wall(const Vector &at_wall) const {
  if (wall_->unknowns() == 0) // BLAS takes no matrix without columns
    return Vector::Zero(2 * mesh_->nodes);
  const Vector forces = wall_->inverse().answer(at_wall);
  Vector velocity(2 * mesh_->nodes);
  for (std::size_t k = 0; k < couplings_.size(); ++k)
    velocity(mesh_->rows(k)) = couplings_[k].from_wall() * forces;
  return velocity;
}

template <class Answer>
Answer Interaction::answer_of_wall() const {
  Answer answer(2 * mesh_->nodes, wall_->unknowns());
  for (std::size_t k = 0; k < couplings_.size(); ++k) {
    const Answer of_membrane = wall_->inverse().answers<Answer>(couplings_[k].from_wall());
    answer(mesh_->rows(k), Eigen::all) = of_membrane;
  }
  return answer;
}
template RowMatrix Interaction::answer_of_wall() const;
template RoughMatrix Interaction::answer_of_wall() const;

Vector Interaction::velocity_at(const Targets &points, const Vector &single_density,
                                const Vector &double_density) const {
  const auto layer = [&](const RingKernel &kernel, const Vector &density) -> Vector {
    return layer_with_images(kernel, points, shape_.panels, nullptr, mesh_->near, images_) *
           mesh_->at_panels(density);
  };
  Vector velocity = layer(ring_stokeslet, single_density);
  Vector at_wall = single_at_wall(single_density);
  if (double_density.size() > 0) {
    velocity += layer(ring_stresslet, double_density);
    at_wall += double_at_wall(double_density);
  }
  return velocity - wall_->velocity_of(at_wall, points);
}

} // namespace capsule
