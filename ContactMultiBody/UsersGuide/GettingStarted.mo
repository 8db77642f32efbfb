within ContactMultiBody.UsersGuide;
class GettingStarted "Five steps to a first collision"
  extends Modelica.Icons.Information;
  annotation (DocumentationClass=true, Documentation(info="<html>
<ol>
<li>Take a MultiBody model and exchange the bodies that shall collide for those of <a href=\"modelica://ContactMultiBody.Parts\">Parts</a>; all their parameters stay.</li>
<li>Give each a geometry in the frame you will connect, such as <code>geometry=Shapes.sphere(0.1)</code> or
<code>geometry=Shapes.compound({Shapes.box({0.1,0.1,0.2}), Shapes.capsule(0.02, 0.3)})</code>, and a material, such as <code>material=Materials.Steel()</code>.</li>
<li>Add a <a href=\"modelica://ContactMultiBody.Parts.Ground\">Ground</a> if there is a floor or a wall.</li>
<li>Add a <a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a> with <code>n</code>, <code>geometry={...}</code> and <code>material={...}</code>, and connect
<code>body.frame_a</code> to <code>contacts.frame[i]</code> in the same order. Name the <code>pairs</code> that can meet.</li>
<li>Simulate with a solver that handles stiff models and events, at a tolerance of 1e-6 or less, and plot <code>contacts.distance</code> and <code>contacts.normalForce</code>.</li>
</ol>
<p>
<a href=\"modelica://ContactMultiBody.Examples.BallOnFloor\">BallOnFloor</a> is the smallest complete model.
</p>
</html>"));
end GettingStarted;
