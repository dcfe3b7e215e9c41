"""Judges the motions that another tool has found: those of Open3D's RANSAC on feature histograms, and of its ICP."""

import numpy as np
import open3d

import crude_registration as cr

statue = cr.make_statue()
images = [cr.simulate(statue, (-np.cos(a), -np.sin(a), -0.25), samples=200, noise=0.1)[0] for a in (0, 0.6)]
scans = [cr.Scan(image) for image in images]

# Open3D wants radii, in the unit of the data: multiples of the distance of samples, which we know.
spacing = 3 * max(scan.spacing for scan in scans)
pipeline = open3d.pipelines.registration
clouds, features = [], []
for image in images:
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(image.points)).voxel_down_sample(spacing)
    cloud.estimate_normals(open3d.geometry.KDTreeSearchParamHybrid(2 * spacing, 30))
    cloud.orient_normals_to_align_with_direction((0, 0, 1))  # towards the scanner, which looks along -z
    clouds.append(cloud)
    features.append(pipeline.compute_fpfh_feature(cloud, open3d.geometry.KDTreeSearchParamHybrid(5 * spacing, 100)))
open3d.utility.random.seed(1)
found = {
    "RANSAC": pipeline.registration_ransac_based_on_feature_matching(
        *clouds, *features, True, 1.5 * spacing, pipeline.TransformationEstimationPointToPoint(False), 3
    ).transformation,
    "ICP": pipeline.registration_icp(*clouds, 5 * spacing, np.eye(4)).transformation,
}

for name, motion in found.items():
    judgement = cr.judge(*scans, motion)
    print(name, judgement.status, f"confidence {judgement.confidence:.3f}, displacement {judgement.displacement:.3g}")
    if judgement.status is cr.MotionStatus.REFINABLE:
        print(judgement.refined.T_target_source)

# What is wrong is told as such: upside down.
assert cr.judge(*scans, np.diag([-1.0, -1.0, 1.0, 1.0])).status is cr.MotionStatus.WRONG
