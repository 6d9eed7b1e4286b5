// Times Pinocchio's aba on a body that compare.py writes as plain numbers: what a C++ user of the library gets, with no
// Python in between. Everything comes from the library's headers, so the compiler of this file is the compiler of aba.
//
// Prints the largest difference from the expected accelerations, as a fraction of the largest, and the least of many
// medians, ns.

#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/multibody.hpp>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <vector>

using Numbers = Eigen::VectorXd;

static Numbers read(std::istream &in, int count) {
  Numbers numbers(count);
  for (int i = 0; i < count; i++)
    in >> numbers[i];
  return numbers;
}

int main(int, char **arguments) {
  std::ifstream in(arguments[1]);
  pinocchio::Model model;
  int bodies;
  double gravity;
  in >> bodies >> gravity;
  model.gravity.linear() = Eigen::Vector3d(0, 0, -gravity);
  std::vector<pinocchio::JointIndex> ids;
  for (int n = 0; n < bodies; n++) {
    int parent, hinge;
    in >> parent >> hinge;
    const Eigen::Vector3d place = read(in, 3);
    const Numbers mass_and_cg = read(in, 2);
    const Eigen::Vector3d inertia = read(in, 3);
    const pinocchio::SE3 at(Eigen::Matrix3d::Identity(), place);
    const auto name = std::to_string(n);
    if (parent < 0)
      ids.push_back(model.addJoint(0, pinocchio::JointModelFreeFlyer(), at, name));
    else if (hinge)
      ids.push_back(model.addJoint(ids[parent], pinocchio::JointModelRY(), at, name));
    else
      ids.push_back(model.addJoint(ids[parent], pinocchio::JointModelSpherical(), at, name));
    model.appendBodyToJoint(ids[n],
                            pinocchio::Inertia(mass_and_cg[0], Eigen::Vector3d(0, 0, mass_and_cg[1]),
                                               Eigen::Matrix3d(inertia.asDiagonal())),
                            pinocchio::SE3::Identity());
  }
  const Numbers q = read(in, model.nq), v = read(in, model.nv), expected = read(in, model.nv);
  const Numbers tau = Numbers::Zero(model.nv);
  if (!in) {
    std::cerr << "the numbers end too early\n";
    return 2;
  }
  pinocchio::Data data(model);
  const Numbers found = pinocchio::aba(model, data, q, v, tau);
  const double error = (found - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();

  const int calls = 50, rounds = 400;
  double least = 1e300;
  for (int round = 0; round < rounds; round++) {
    double samples[9];
    for (double &sample : samples) {
      const auto start = std::chrono::steady_clock::now();
      for (int i = 0; i < calls; i++)
        pinocchio::aba(model, data, q, v, tau);
      sample = std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() / calls;
    }
    std::nth_element(samples, samples + 4, samples + 9);
    least = std::min(least, samples[4]);
  }
  std::cout << error << " " << least << "\n";
}
