# The tests of the shapes, and of the program as its users see it.
meshhood_test(shapes meshhood_shapes)
