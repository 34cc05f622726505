"""The robot's kinematics in exact form: the chain of joints, its poses and Jacobians."""
