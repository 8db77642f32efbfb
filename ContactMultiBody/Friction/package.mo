within ContactMultiBody;
package Friction "Laws of friction between bodies"
  extends Modelica.Icons.FunctionsPackage;

  annotation (Documentation(info="<html>
<p>
Tangential forces at contact points from normal forces and sliding velocities. Both laws act at every contact point, and the forces of the points add up: a face that slides, turns, or does both is braked as the points of its
contact are. <a href=\"modelica://ContactMultiBody.Friction.regularised\">Regularised</a> friction has no states and creeps; <a href=\"modelica://ContactMultiBody.Friction.anchoredPatch\">anchored</a> friction has six a pair and holds. Points that lie on one spot, as of a
sphere, do not resist turning about the normal; <a href=\"modelica://ContactMultiBody.Friction.spinTorque\">spinTorque</a> adds that for both.
</p>
<h4>Anchored friction as a patch</h4>
<p>
Juh&aacute;sz 2008 (equations 5 to 9) holds each contact point by a spring between it and an anchor, limited by &mu; F<sub>n</sub>. The points of a manifold come and go and change their places as bodies roll and rock, so that an anchor a point cannot be kept. But bodies
are rigid: while they stick, the anchors of all points move against the points as one rigid body. Six states are thus all there is to know: q = (z, &#968;), translation z and turning &#968; = &#961; &#952; about the centre of the friction, as a
length by the radius of gyration &#961; of the points. The stretch at point k is s<sub>k</sub> = G<sub>k</sub>' q, the tangential part of z + &#968; &#215; r<sub>k</sub>/&#961;; the velocity of the patch is V = &#931; w<sub>k</sub> G<sub>k</sub> v<sub>k</sub>, with weights of the points w<sub>k</sub>.
</p>
<p><strong>No energy from nothing.</strong> The springs store U = S q<sup>2</sup>/2. Force and rate are</p>
<blockquote><pre>
F_k = -c S w_k G_k' q - (damper along v_k)
q'  =  c (V - a P q) + W x q - R q
</pre></blockquote>
<p>
with 0 &#8804; a, c &#8804; 1, matrices P and R that are never negative, and W &#215; q, the turning with the bodies. The power that the bodies put in is -&#931; F<sub>k</sub> v<sub>k</sub> = c S q V + damper, and dU/dt = c S q V - c a S q P q - S q R q. The difference, what friction takes,
</p>
<blockquote><pre>
-sum F_k v_k - dU/dt = c a S q P q + S q R q + damper  >=  0
</pre></blockquote>
<p>
is never negative, in any state, for any points, normals and forces, however they change: the spring hangs on the bodies by a modulated transformer (H. M. Paynter's bond graphs), which has the same ratio for forces and velocities. That is why the turning is a state as
a length and not as an angle: the energy S &#961;<sup>2</sup>&#952;<sup>2</sup>/2 of an angle would change with &#961; as the pressure does, without anybody's work. A body that rolls has v<sub>k</sub> = 0 where it touches, so that q' = 0 wherever its points wander. When bodies part,
w<sub>k</sub> goes to zero with the normal force: what the springs then hold is lost, not given.
</p>
<p>
<strong>Where it slips.</strong> The largest resultants that friction at the points can have make up the limit surface (Goyal, Ruina and Papadopoulos 1991): the sum of discs, or, seen from a velocity, the one that takes the most power: the sum of
-&mu; F<sub>n</sub> v/|v|. P is chosen so that steady sliding of a flat patch ends there exactly, with any centre of rotation, and not on an ellipsoid that stands for it (Howe and Cutkosky 1996); on one point, and in translation, P is the associated flow, normal
to the circle. The share a goes from 0, where the first point has 0.9 of its limit, to 1, where it slips: below nothing creeps (Dupont, Hayward, Armstrong and Altpeter 2002).
</p>
<h4>What a manifold's points promise</h4>
<p>
The pressure of a face stands at its points: of a box on its corners, of a cylinder on its rim. In translation this makes no difference. A box that spins on a square face of edge a, or a cylinder on its end of radius R, is
braked by T = &mu; F<sub>n</sub> times
</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"2\">
<tr><th></th><th>even pressure</th><th>points of the ContactManager</th><th>of the VolumeContactManager</th></tr>
<tr><td>square</td><td>0.3826 a</td><td>0.7071 a</td><td>0.4082 a</td></tr>
<tr><td>disc</td><td>0.6667 R</td><td>R</td><td>0.7071 R</td></tr>
</table>
<p>
The friction is that of its points to the accuracy of the integration; rigid faces on rigid floors have no pressure that could be known better. Where even pressure is meant, as on pads and mats, take the
<a href=\"modelica://ContactMultiBody.VolumeContactManager\">VolumeContactManager</a>.
</p>
<h4>Literature</h4>
<ul>
<li>T. Juh&aacute;sz: Advanced Solutions in Object-Oriented Mechatronic Simulation. Dissertation, Budapest 2008.</li>
<li>S. Goyal, A. Ruina, J. Papadopoulos: Planar sliding with dry friction, part 1: limit surface and moment function. Wear 143 (1991).</li>
<li>R. D. Howe, M. R. Cutkosky: Practical force-motion models for sliding manipulation. International Journal of Robotics Research 15 (1996).</li>
<li>P. Dupont, V. Hayward, B. Armstrong, F. Altpeter: Single state elastoplastic friction models. IEEE Transactions on Automatic Control 47 (2002).</li>
</ul>
</html>"));
end Friction;
