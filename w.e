tetwedge: [   0.038 s] read 24 vertices, 44 triangles, 0 tetrahedra
tetwedge: [   0.048 s] about 4 400 tetrahedra, about 1 second
tetwedge: [   0.049 s] template 0: 16 points, 32 triangles in 16 facets, 0 void(s); switches p90q1.47/6.666666666666666AannJS50000
tetwedge: [   0.053 s] TetGen: Delaunizing vertices...
tetwedge: [   0.053 s] TetGen: Delaunay seconds:  0.000188
tetwedge: [   0.053 s] TetGen: Creating surface mesh ...
tetwedge: [   0.053 s] TetGen: Surface mesh seconds:  0.000106
tetwedge: [   0.053 s] TetGen: Constrained Delaunay...
tetwedge: [   0.053 s] TetGen: Constrained Delaunay seconds:  0.0001
tetwedge: [   0.053 s] TetGen: Removing exterior tetrahedra ...
tetwedge: [   0.053 s] TetGen: Spreading region attributes.
tetwedge: [   0.053 s] TetGen: Exterior tets removal seconds:  1.7e-05
tetwedge: [   0.053 s] TetGen: Refining mesh...
tetwedge: [   0.080 s] TetGen: Refinement seconds:  0.012522
tetwedge: [   0.080 s] TetGen: Optimizing mesh...
tetwedge: [   0.080 s] TetGen: Optimization seconds:  0.000762
tetwedge: [   0.080 s] TetGen: Writing nodes.
tetwedge: [   0.080 s] TetGen: Writing elements.
tetwedge: [   0.080 s] TetGen: Writing faces.
tetwedge: [   0.080 s] TetGen: Writing edges.
tetwedge: [   0.080 s] TetGen: Writing neighbors.
tetwedge: [   0.080 s] TetGen: Output seconds:  0.000219
tetwedge: [   0.080 s] TetGen: Total running seconds:  0.014022
tetwedge: [   0.080 s] TetGen: Statistics:
tetwedge: [   0.080 s] TetGen: Input points: 16
tetwedge: [   0.080 s] TetGen: Input facets: 32
tetwedge: [   0.080 s] TetGen: Input segments: 28
tetwedge: [   0.080 s] TetGen: Input holes: 0
tetwedge: [   0.080 s] TetGen: Input regions: 3
tetwedge: [   0.080 s] TetGen: Mesh points: 919
tetwedge: [   0.080 s] TetGen: Mesh tetrahedra: 3489
tetwedge: [   0.080 s] TetGen: Mesh faces: 7644
tetwedge: [   0.080 s] TetGen: Mesh faces on facets: 1514
tetwedge: [   0.080 s] TetGen: Mesh edges on segments: 203
tetwedge: [   0.080 s] TetGen: Steiner points inside domain: 194
tetwedge: [   0.080 s] TetGen: Steiner points on facets:  534
tetwedge: [   0.080 s] TetGen: Steiner points on segments:  175
tetwedge: [   0.083 s] template 0: 3489 tetrahedra; prepared in 0.000 s, meshed in 0.034 s
tetwedge: [   0.125 s] template 0: 296 tetrahedra to be improved, 1 remain; 370 vertices moved, 1 added, 306 edges and faces replaced
tetwedge: [   0.125 s] template 0: 76 vertices of the mesher's were taken out that the elements do not need
tetwedge: [   0.125 s] template 0: 3128 tetrahedra, 844 vertices; checked in 0.042 s
tetwedge: [   1.476 s] template 0: the best of 6 meshes has 3106 tetrahedra, none with an angle below 26.7 degrees
tetwedge: [   1.476 s] template 1: 29 points, 54 triangles in 6 facets, 0 void(s); switches p90q1.5434999999999999/6.666666666666666AannJS50000
tetwedge: [   1.479 s] TetGen: Delaunizing vertices...
tetwedge: [   1.479 s] TetGen: Delaunay seconds:  0.000255
tetwedge: [   1.479 s] TetGen: Creating surface mesh ...
tetwedge: [   1.479 s] TetGen: Surface mesh seconds:  0.000109
tetwedge: [   1.479 s] TetGen: Constrained Delaunay...
tetwedge: [   1.479 s] TetGen: Constrained Delaunay seconds:  9.5e-05
tetwedge: [   1.479 s] TetGen: Removing exterior tetrahedra ...
tetwedge: [   1.479 s] TetGen: Spreading region attributes.
tetwedge: [   1.479 s] TetGen: Exterior tets removal seconds:  2.3e-05
tetwedge: [   1.479 s] TetGen: Refining mesh...
tetwedge: [   1.486 s] TetGen: Refinement seconds:  0.000819
tetwedge: [   1.486 s] TetGen: Optimizing mesh...
tetwedge: [   1.486 s] TetGen: Optimization seconds:  7.8e-05
tetwedge: [   1.486 s] TetGen: Writing nodes.
tetwedge: [   1.486 s] TetGen: Writing elements.
tetwedge: [   1.486 s] TetGen: Writing faces.
tetwedge: [   1.486 s] TetGen: Writing edges.
tetwedge: [   1.486 s] TetGen: Writing neighbors.
tetwedge: [   1.486 s] TetGen: Output seconds:  2.4e-05
tetwedge: [   1.486 s] TetGen: Total running seconds:  0.001483
tetwedge: [   1.486 s] TetGen: Statistics:
tetwedge: [   1.486 s] TetGen: Input points: 29
tetwedge: [   1.486 s] TetGen: Input facets: 54
tetwedge: [   1.486 s] TetGen: Input segments: 33
tetwedge: [   1.486 s] TetGen: Input holes: 0
tetwedge: [   1.486 s] TetGen: Input regions: 1
tetwedge: [   1.486 s] TetGen: Mesh points: 56
tetwedge: [   1.486 s] TetGen: Mesh tetrahedra: 106
tetwedge: [   1.486 s] TetGen: Mesh faces: 266
tetwedge: [   1.486 s] TetGen: Mesh faces on facets: 108
tetwedge: [   1.486 s] TetGen: Mesh edges on segments: 44
tetwedge: [   1.486 s] TetGen: Steiner points on facets:  16
tetwedge: [   1.486 s] TetGen: Steiner points on segments:  11
tetwedge: [   1.486 s] template 1: 106 tetrahedra; prepared in 0.000 s, meshed in 0.009 s
tetwedge: [   1.486 s] template 1: 48 points, 92 triangles in 6 facets, 0 void(s); switches p90q1.47/6.666666666666666AaYnnJS50000
tetwedge: [   1.487 s] TetGen: Delaunizing vertices...
tetwedge: [   1.490 s] TetGen: Delaunay seconds:  0.000335
tetwedge: [   1.490 s] TetGen: Creating surface mesh ...
tetwedge: [   1.490 s] TetGen: Surface mesh seconds:  9.8e-05
tetwedge: [   1.490 s] TetGen: Recovering boundaries...
tetwedge: [   1.490 s] TetGen: Boundary recovery seconds:  0.000111
tetwedge: [   1.490 s] TetGen: Removing exterior tetrahedra ...
tetwedge: [   1.490 s] TetGen: Spreading region attributes.
tetwedge: [   1.496 s] TetGen: Exterior tets removal seconds:  3.8e-05
tetwedge: [   1.496 s] TetGen: Recovering Delaunayness...
tetwedge: [   1.496 s] TetGen: Delaunay recovery seconds:  0.000147
tetwedge: [   1.496 s] TetGen: Refining mesh...
tetwedge: [   1.496 s] TetGen: Refinement seconds:  0.000149
tetwedge: [   1.496 s] TetGen: Optimizing mesh...
tetwedge: [   1.496 s] TetGen: Optimization seconds:  3.4e-05
tetwedge: [   1.496 s] TetGen: Writing nodes.
tetwedge: [   1.496 s] TetGen: Writing elements.
tetwedge: [   1.496 s] TetGen: Writing faces.
tetwedge: [   1.496 s] TetGen: Writing edges.
tetwedge: [   1.496 s] TetGen: Writing neighbors.
tetwedge: [   1.496 s] TetGen: Output seconds:  3.6e-05
tetwedge: [   1.496 s] TetGen: Total running seconds:  0.001057
tetwedge: [   1.496 s] TetGen: Statistics:
tetwedge: [   1.496 s] TetGen: Input points: 48
tetwedge: [   1.496 s] TetGen: Input facets: 92
tetwedge: [   1.496 s] TetGen: Input segments: 138
tetwedge: [   1.496 s] TetGen: Input holes: 0
tetwedge: [   1.496 s] TetGen: Input regions: 1
tetwedge: [   1.496 s] TetGen: Mesh points: 48
tetwedge: [   1.496 s] TetGen: Mesh tetrahedra: 90
tetwedge: [   1.496 s] TetGen: Mesh faces: 226
tetwedge: [   1.496 s] TetGen: Mesh faces on facets: 92
tetwedge: [   1.496 s] TetGen: Mesh edges on segments: 138
tetwedge: [   1.497 s] template 1: 90 tetrahedra; prepared in 0.000 s, meshed in 0.011 s
tetwedge: [   1.497 s] template 1: 0 tetrahedra to be improved, 0 remain; 5 vertices moved, 0 added, 5 edges and faces replaced
tetwedge: [   1.497 s] template 1: 86 tetrahedra, 48 vertices; checked in 0.001 s
tetwedge: [   1.588 s] written
